// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

#include "output.hpp"

namespace quadrille::cli {

ProgressLine::ProgressLine(bool wanted) : active_(wanted && ::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const discrete::Progress& progress) {
  if (!active_) return;
  const std::string plan = progress.cost ? fmt::format(", plan {}", *progress.cost) : "";
  const std::string text = fmt::format("cost >= {}{}, {:.1f} s, {} conflicts", progress.lower_bound,
                                       plan, progress.elapsed_s, progress.conflicts);
  // Blanks instead of escape sequences: every terminal knows them.
  print_stderr(fmt::format("\r{:<{}}", text, shown_));
  shown_ = text.size();
}

void ProgressLine::clear() {
  if (shown_ == 0) return;
  print_stderr(fmt::format("\r{:{}}\r", "", shown_));
  shown_ = 0;
}

}  // namespace quadrille::cli
