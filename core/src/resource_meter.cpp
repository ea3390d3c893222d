// SPDX-License-Identifier: MIT
#include "quadrille/core/resource_meter.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <utility>

#include "quadrille/core/limits.hpp"

namespace quadrille {
namespace {

/// Of all solves that run in this process.
std::atomic<std::int64_t> held_by_all{0};

std::int64_t faults(int whose) noexcept {
  rusage usage{};
  getrusage(whose, &usage);
  return std::int64_t{usage.ru_minflt} + usage.ru_majflt;
}

/// Without overflow for all that can be bytes and faults.
std::int64_t share(std::int64_t amount, std::int64_t part, std::int64_t whole) noexcept {
  return static_cast<std::int64_t>(static_cast<double>(amount) * static_cast<double>(part) /
                                   static_cast<double>(whole));
}

}  // namespace

ResourceAccount::ResourceAccount() noexcept : wall_start_(wall_seconds()) {}
double ResourceAccount::wall_s() const noexcept { return wall_seconds() - wall_start_; }
double ResourceAccount::cpu_s() const noexcept { return 1e-9 * static_cast<double>(cpu_ns_); }
double ResourceAccount::memory_mib() const noexcept {
  return static_cast<double>(memory_bytes_) / (1 << 20);
}

ResourceMeter::ResourceMeter(std::shared_ptr<ResourceAccount> account) noexcept
    : account_(std::move(account)), cpu_seen_s_(thread_cpu_seconds()), seen_(memory_now()) {}

ResourceMeter::~ResourceMeter() {
  look_at_cpu();
  held_by_all -= held_bytes_;
}

void ResourceMeter::look_at_cpu() noexcept {
  const double now = thread_cpu_seconds();
  account_->cpu_ns_ += static_cast<std::int64_t>(1e9 * (now - cpu_seen_s_));
  cpu_seen_s_ = now;
}

ResourceMeter::Memory ResourceMeter::memory_now() noexcept {
  return {static_cast<std::int64_t>(current_rss_mib() * (1 << 20)), faults(RUSAGE_THREAD),
          faults(RUSAGE_SELF)};
}

void ResourceMeter::look_at_memory() noexcept {
  const Memory now = memory_now();
  const std::int64_t growth = now.resident_bytes - seen_.resident_bytes;
  std::int64_t change = 0;
  if (growth > 0) {
    const std::int64_t own = now.own_faults - seen_.own_faults;
    const std::int64_t all = std::max(own, now.all_faults - seen_.all_faults);
    change = all == 0 ? growth : share(growth, own, all);
  } else if (growth < 0) {
    const std::int64_t all = std::max(held_bytes_, held_by_all.load());
    if (all > 0) change = std::max(share(growth, held_bytes_, all), -held_bytes_);
  }
  held_bytes_ += change;
  held_by_all += change;
  account_->memory_bytes_ += change;
  seen_ = now;
}

}  // namespace quadrille
