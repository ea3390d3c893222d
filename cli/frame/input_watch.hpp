// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "frame/exit_codes.hpp"
#include "quadrille/core/usage.hpp"

namespace quadrille::cli {

/// Holds the limits, and heeds signals, while input is read and checked. That may take for ever
/// where nobody looks at limits: a pipe need not deliver. So it is a thread that waits, and that
/// ends the program when it is time, whatever the others are doing.
class InputWatch {
 public:
  /// Tells what there is to tell, and returns the exit code with which the program ends at once.
  /// Runs in the thread of the watch, while the input is being read in another one.
  using End = std::function<ExitCode(StopReason, const Usage&)>;

  /// The limits count from now on. Those of time allow for kGraceSeconds of computing more, so that
  /// of small instances something is known even if they are 0, and for a second of waiting.
  /// Without another thread, which the system may refuse, nothing is watched.
  InputWatch(const Limits& limits, End end);
  ~InputWatch();
  InputWatch(const InputWatch&) = delete;
  InputWatch& operator=(const InputWatch&) = delete;

  /// The input is there. Does not return if the end has come. What was used until now.
  Usage finish();

 private:
  void run();
  [[nodiscard]] StopReason look() const;
  [[nodiscard]] Usage usage() const;

  const Limits limits_;
  const End end_;
  const double wall_begin_, cpu_begin_, memory_begin_;
  std::mutex mutex_;  // held by the watch but for when it waits
  std::condition_variable finished_;
  bool is_finished_ = false;
  std::thread thread_;
};

}  // namespace quadrille::cli
