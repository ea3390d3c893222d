// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "quadrille/core/outcome.hpp"

namespace quadrille {

/// Seconds of wall-clock time since an arbitrary fixed moment (monotonic).
[[nodiscard]] double wall_seconds() noexcept;
/// Seconds of CPU time used by this process.
[[nodiscard]] double cpu_seconds() noexcept;
/// Largest resident set of this process so far, in MiB.
[[nodiscard]] double peak_rss_mib() noexcept;
/// Resident set of this process now, in MiB; 0 where the system does not tell.
[[nodiscard]] double current_rss_mib() noexcept;

/// What a search may use. An absent limit does not bind. All are counted from the moment the
/// LimitMonitor is made, but memory, which is the process's resident set.
struct Limits {
  std::optional<double> wall_s;
  std::optional<double> cpu_s;
  std::optional<double> memory_mib;
  std::optional<std::int64_t> conflicts;
  /// Set from anywhere (a signal handler, another thread) to stop the search soon. May be null.
  const std::atomic<bool>* interrupt = nullptr;
};

/// Watches Limits during one search. Once a limit is met it stays met. One thread.
class LimitMonitor {
 public:
  explicit LimitMonitor(const Limits& limits);

  /// True when the search has to stop. Looks at the interrupt flag and the conflict count at every
  /// call, at clocks every 16th and at memory every 1024th call.
  [[nodiscard]] bool exhausted();
  /// As `exhausted`, but looks at everything now.
  [[nodiscard]] bool exhausted_now();

  /// Calls `listener` from within `exhausted` about every `interval_s` seconds.
  void set_ticker(double interval_s, std::function<void()> listener);

  /// A second interrupt flag. May be null; must outlive the monitor otherwise.
  void set_cancel(const std::atomic<bool>* cancel) noexcept { cancel_ = cancel; }
  /// Calls `listener` after each conflict that is counted.
  void set_conflict_listener(std::function<void()> listener);
  /// From now on, and if no limit was met before, the search has to stop for that reason.
  void stop(StopReason reason) noexcept;

  void add_conflicts(std::int64_t count);
  [[nodiscard]] std::int64_t conflicts() const noexcept { return conflicts_; }
  [[nodiscard]] StopReason reason() const noexcept { return reason_; }
  /// Since the monitor was made.
  [[nodiscard]] double elapsed_wall() const noexcept;
  [[nodiscard]] double elapsed_cpu() const noexcept;

 private:
  Limits limits_;
  const std::atomic<bool>* cancel_ = nullptr;
  double wall_start_, cpu_start_;
  std::int64_t conflicts_ = 0;
  std::uint32_t calls_ = 0;
  StopReason reason_ = StopReason::none;
  std::function<void()> ticker_, conflict_listener_;
  double tick_interval_ = 0, next_tick_ = 0;
};

}  // namespace quadrille
