// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "quadrille/core/result.hpp"
#include "quadrille/input/source.hpp"

namespace quadrille::cli {

/// The file of a plan, which may be a pipe and is read more than once: its text is kept.
class GivenPlan {
 public:
  explicit GivenPlan(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  /// Reads the file when it is first asked for. Errors: those of input::read_text.
  [[nodiscard]] const Result<std::string>& text() {
    if (!text_) text_ = input::read_text(file_);
    return *text_;
  }

 private:
  std::string file_;
  std::optional<Result<std::string>> text_;
};

}  // namespace quadrille::cli
