// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "quadrille/continuous/resolution.hpp"
#include "quadrille/core/progress.hpp"

namespace quadrille::cli {

/// Costs in timesteps, or of a roadmap in the units of its input.
[[nodiscard]] std::string progress_text(const Progress& progress);
[[nodiscard]] std::string progress_text(const Progress& progress,
                                        const continuous::Resolution& resolution);

/// One line on a terminal's stderr that is rewritten in place and gone at the end.
class ProgressLine {
 public:
  /// Silent unless `wanted` and stderr is a terminal.
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  [[nodiscard]] bool active() const noexcept { return active_; }
  void show(const std::string& text);
  void clear();

 private:
  bool active_;
  std::size_t shown_ = 0;  // characters on the line
};

}  // namespace quadrille::cli
