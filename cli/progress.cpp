// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "output.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::cli {

std::string progress_text(const discrete::Progress& progress) {
  const std::string plan = progress.cost ? fmt::format(", plan {}", *progress.cost) : "";
  return fmt::format("cost >= {}{}, {:.1f} s, {} conflicts", progress.lower_bound, plan,
                     progress.elapsed_s, progress.conflicts);
}

std::string progress_text(const continuous::Progress& progress, double resolution) {
  const auto time = [&](Cost ticks) { return continuous::in_input_units(ticks, resolution); };
  const std::string plan = progress.cost ? fmt::format(", plan {}", time(*progress.cost)) : "";
  return fmt::format("cost >= {}{}, {:.1f} s, {} conflicts", time(progress.lower_bound), plan,
                     progress.elapsed_s, progress.conflicts);
}

ProgressLine::ProgressLine(bool wanted) : active_(wanted && ::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (!active_) return;
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
