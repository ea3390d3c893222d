// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "quadrille/core/export.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/resource_meter.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Seconds of wall-clock time since an arbitrary fixed moment (monotonic).
[[nodiscard]] double wall_seconds() noexcept;
/// Seconds of CPU time used by this process.
[[nodiscard]] double cpu_seconds() noexcept;
/// Seconds of CPU time used by the calling thread.
[[nodiscard]] double thread_cpu_seconds() noexcept;
/// Largest resident set of this process so far, in MiB.
[[nodiscard]] double peak_rss_mib() noexcept;
/// Resident set of this process now, in MiB; 0 where the system does not tell.
[[nodiscard]] double current_rss_mib() noexcept;

/// Of one search, at most.
inline constexpr std::size_t kMaxThreads = 64;

/// What a search may use. An absent limit does not bind. All belong to the search, not to the
/// process: what its host or another search uses does not count. See ResourceMeter.
struct Limits {
  std::optional<double> wall_s;
  std::optional<double> cpu_s;       ///< Of all threads of the search together.
  std::optional<double> memory_mib;  ///< Resident memory that the search adds to the process.
  std::optional<std::int64_t> conflicts;
  /// Set from anywhere (a signal handler, another thread) to stop the search soon. May be null.
  const std::atomic<bool>* interrupt = nullptr;
  /// Stops as if interrupted when a monitor is asked for the so-manieth time: for tests of what is
  /// left behind by a search that is cut short anywhere.
  std::optional<std::int64_t> looks;
};

/// Thrown where a computation is so deep inside others that it cannot say that it was cut short.
/// The searches of this library catch it; nobody else gets to see it.
struct LimitReached {};

/// Watches Limits during one search: a budget and a stop token. Once a limit is met it stays met.
/// Everything of length asks it, and so it is the pulse of a search, too. To be used by the thread
/// that made it.
class LimitMonitor {
 public:
  /// A search of several threads has one monitor for each of them and one account for all; null: an
  /// account of its own.
  explicit LimitMonitor(const Limits& limits, std::shared_ptr<ResourceAccount> account = nullptr);

  /// True when the search has to stop. Looks at the interrupt flag and the conflict count at every
  /// call, at the wall clock every 16th, and then once a millisecond at CPU time and memory.
  [[nodiscard]] bool exhausted();
  /// As `exhausted`, but looks at the clocks now, and once a millisecond at memory.
  [[nodiscard]] bool exhausted_now();
  /// Whether `bytes` more would be within the limit of memory; to be asked before a large table is
  /// made. If not, the limit counts as met.
  [[nodiscard]] bool has_room_for(std::size_t bytes);
  /// As `exhausted` and `has_room_for`, but throw LimitReached if the search has to stop.
  void check();
  void check_room_for(std::size_t bytes);

  /// A second interrupt flag. May be null; must outlive the monitor otherwise.
  void set_cancel(const std::atomic<bool>* cancel) noexcept { cancel_ = cancel; }
  /// To be called whenever the monitor looks at the wall clock, until a limit is met; what it
  /// throws comes out of who asked. Empty: nothing.
  void set_pulse(std::function<void()> pulse) { pulse_ = std::move(pulse); }
  /// As long as it lives the monitor has no pulse: for what must not be left by an exception of a
  /// user, nor entered again by what a user does.
  class Quiet {
   public:
    explicit Quiet(LimitMonitor& monitor) noexcept : monitor_(monitor) { ++monitor.num_quiet_; }
    ~Quiet() { --monitor_.num_quiet_; }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;

   private:
    LimitMonitor& monitor_;
  };
  /// From now on, and if no limit was met before, the search has to stop for that reason.
  void stop(StopReason reason) noexcept;

  void add_conflicts(std::int64_t count) noexcept { conflicts_ += count; }
  [[nodiscard]] std::int64_t conflicts() const noexcept { return conflicts_; }
  [[nodiscard]] StopReason reason() const noexcept { return reason_; }
  /// Since the account was made; CPU time is that of all its threads.
  [[nodiscard]] double elapsed_wall() const noexcept;
  [[nodiscard]] double elapsed_cpu() noexcept;

 private:
  /// Counts the call and looks at what costs nothing. True when the search has to stop.
  bool look();
  void look_at_meter(bool at_cpu);

  Limits limits_;
  const std::atomic<bool>* cancel_ = nullptr;
  ResourceMeter meter_;
  std::function<void()> pulse_;
  double next_look_ = 0;
  std::int64_t conflicts_ = 0;
  std::int64_t calls_ = 0;
  StopReason reason_ = StopReason::none;
  int num_quiet_ = 0;
};

}  // namespace quadrille

QUADRILLE_API_END
