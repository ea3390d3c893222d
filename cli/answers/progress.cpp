// SPDX-License-Identifier: MIT
#include "answers/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "answers/report.hpp"
#include "frame/output.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::cli {

namespace {

/// `print`: how a cost is written.
template <class Print>
std::string text_of(const Progress& progress, const Print& print) {
  if (progress.phase == Phase::set_up)
    return fmt::format("{}, {:.1f} s", to_string(progress.phase), progress.elapsed_s);
  std::string plan;
  if (progress.cost)
    plan = fmt::format(", plan {}{}", print(*progress.cost),
                       gap_text(gap_percent(*progress.cost, progress.lower_bound)));
  return fmt::format("{}: cost >= {}{}, {:.1f} s, {} conflicts", to_string(progress.phase),
                     print(progress.lower_bound), plan, progress.elapsed_s, progress.conflicts);
}

}  // namespace

std::string progress_text(const Progress& progress) {
  return text_of(progress, [](Cost cost) { return cost; });
}

std::string progress_text(const Progress& progress, const continuous::Resolution& resolution) {
  return text_of(progress,
                 [&](Cost ticks) { return continuous::in_input_units(ticks, resolution); });
}

ProgressLine::ProgressLine(bool wanted) : active_(wanted && ::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const std::string& text) {
  if (!active_) return;
  // Blanks instead of escape sequences: every terminal knows them.
  print_on_line(fmt::format("{:<{}}", text, shown_));
  shown_ = text.size();
}

void ProgressLine::clear() {
  if (shown_ == 0) return;
  print_on_line(std::string(shown_, ' '));
  print_on_line("");
  shown_ = 0;
}

}  // namespace quadrille::cli
