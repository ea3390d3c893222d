// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace quadrille::cli {

ProgressLine::ProgressLine(bool wanted) : active_(wanted && ::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const discrete::Progress& progress) {
  if (!active_) return;
  const std::string text = fmt::format("cost >= {}, {:.1f} s, {} conflicts", progress.lower_bound,
                                       progress.elapsed_s, progress.conflicts);
  // Blanks instead of escape sequences: every terminal knows them.
  std::fprintf(stderr, "\r%-*s", static_cast<int>(shown_), text.c_str());
  std::fflush(stderr);
  shown_ = text.size();
}

void ProgressLine::clear() {
  if (shown_ == 0) return;
  std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown_), "");
  std::fflush(stderr);
  shown_ = 0;
}

}  // namespace quadrille::cli
