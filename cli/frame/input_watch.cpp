// SPDX-License-Identifier: MIT
#include "frame/input_watch.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <new>
#include <system_error>
#include <utility>

#include "frame/output.hpp"
#include "quadrille/core/free_bound.hpp"

namespace quadrille::cli {
namespace {

constexpr std::chrono::milliseconds kInterval{10};
/// Of a clock that goes on while others have the processor.
constexpr double kGraceOfWaiting = 1;  // s

}  // namespace

InputWatch::InputWatch(const Limits& limits, End end)
    : limits_(limits),
      end_(std::move(end)),
      wall_begin_(wall_seconds()),
      cpu_begin_(cpu_seconds()),
      memory_begin_(current_rss_mib()) {
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
  }
}

InputWatch::~InputWatch() { finish(); }

Usage InputWatch::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_finished_ = true;
  }
  finished_.notify_one();
  if (thread_.joinable()) thread_.join();
  return usage();
}

void InputWatch::run() {
  std::unique_lock lock(mutex_);
  while (!finished_.wait_for(lock, kInterval, [this] { return is_finished_; })) {
    const StopReason reason = look();
    if (reason == StopReason::none) continue;
    ExitCode code = ExitCode::memory;
    try {
      code = end_(reason, usage());
    } catch (const std::bad_alloc&) {
      print_stderr("quadrille: error: the system has no more memory\n");
    }
    // Destructors would meet those who are at work.
    std::_Exit(static_cast<int>(code));
  }
}

StopReason InputWatch::look() const {
  const Usage used = usage();
  const auto is_over = [&](double limit) {
    return used.wall_s >= limit &&
           (used.cpu_s >= limit + kGraceSeconds || used.wall_s >= limit + kGraceOfWaiting);
  };
  if (limits_.interrupt != nullptr && *limits_.interrupt) return StopReason::interrupt;
  if (limits_.wall_s && is_over(*limits_.wall_s)) return StopReason::wall_time;
  if (limits_.cpu_s && used.cpu_s >= *limits_.cpu_s + kGraceSeconds) return StopReason::cpu_time;
  if (limits_.memory_mib && used.memory_mib >= *limits_.memory_mib) return StopReason::memory;
  return StopReason::none;
}

Usage InputWatch::usage() const {
  const double memory = limits_.memory_mib ? current_rss_mib() - memory_begin_ : 0;
  return {wall_seconds() - wall_begin_, cpu_seconds() - cpu_begin_, std::max(0.0, memory)};
}

}  // namespace quadrille::cli
