// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <list>
#include <memory>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What the threads of one solve have used so far, together. Safe to read from any thread.
class ResourceAccount {
 public:
  ResourceAccount() noexcept;
  ResourceAccount(const ResourceAccount&) = delete;
  ResourceAccount& operator=(const ResourceAccount&) = delete;

  /// Seconds of wall-clock time since the account was made.
  [[nodiscard]] double wall_s() const noexcept;
  /// Seconds of CPU time, as of the threads' last looks.
  [[nodiscard]] double cpu_s() const noexcept;
  /// MiB of resident memory that the solve has added to the process, as of the threads' last looks.
  [[nodiscard]] double memory_mib() const noexcept;

 private:
  friend class ResourceMeter;
  const double wall_start_;
  std::atomic<std::int64_t> cpu_ns_{0}, memory_bytes_{0};
};

/// Adds what one thread uses to an account. A meter is used by the thread that made it only, and
/// destroyed there. Several of one thread for one account count together, whichever looks: a solve
/// inside of a solve is charged once.
///
/// CPU time is the thread's own clock. Resident memory is known for the process alone, so a thread
/// is charged with the growth since its last look in proportion to its page faults among the
/// process's: memory that becomes resident is touched first by who uses it. The charge is exact as
/// long as no other thread allocates. Memory that is given back is credited to the solves that run,
/// in proportion to what they hold. With transparent huge pages, concurrent solves are told apart
/// less exactly: their faults are not all of one size.
class ResourceMeter {
 public:
  explicit ResourceMeter(std::shared_ptr<ResourceAccount> account);
  /// A last look at the CPU time.
  ~ResourceMeter();
  ResourceMeter(const ResourceMeter&) = delete;
  ResourceMeter& operator=(const ResourceMeter&) = delete;

  /// A system call each.
  void look_at_cpu() noexcept;
  void look_at_memory() noexcept;
  [[nodiscard]] const ResourceAccount& account() const noexcept { return *account_; }

 private:
  struct Memory {
    std::int64_t resident_bytes = 0, own_faults = 0, all_faults = 0;
  };
  /// What a thread has charged to an account so far.
  struct Thread {
    const ResourceAccount* account;
    int num_meters;
    double cpu_seen_s;
    Memory seen;
    std::int64_t held_bytes = 0;
  };
  [[nodiscard]] static Memory memory_now() noexcept;
  /// Those of the calling thread that have a meter.
  [[nodiscard]] static std::list<Thread>& threads() noexcept;
  [[nodiscard]] static std::list<Thread>::iterator join(const ResourceAccount& account);

  const std::shared_ptr<ResourceAccount> account_;
  const std::list<Thread>::iterator thread_;
};

}  // namespace quadrille

QUADRILLE_API_END
