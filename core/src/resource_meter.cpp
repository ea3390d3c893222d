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

std::list<ResourceMeter::Thread>& ResourceMeter::threads() noexcept {
  thread_local std::list<Thread> threads;
  return threads;
}

std::list<ResourceMeter::Thread>::iterator ResourceMeter::join(const ResourceAccount& account) {
  std::list<Thread>& all = threads();
  auto own = std::find_if(all.begin(), all.end(),
                          [&](const Thread& thread) { return thread.account == &account; });
  if (own == all.end())
    own = all.insert(all.end(), {&account, 0, thread_cpu_seconds(), memory_now()});
  ++own->num_meters;
  return own;
}

ResourceMeter::ResourceMeter(std::shared_ptr<ResourceAccount> account)
    : account_(std::move(account)), thread_(join(*account_)) {}

ResourceMeter::~ResourceMeter() {
  look_at_cpu();
  if (--thread_->num_meters > 0) return;
  held_by_all -= thread_->held_bytes;
  threads().erase(thread_);
}

void ResourceMeter::look_at_cpu() noexcept {
  const double now = thread_cpu_seconds();
  account_->cpu_ns_ += static_cast<std::int64_t>(1e9 * (now - thread_->cpu_seen_s));
  thread_->cpu_seen_s = now;
}

ResourceMeter::Memory ResourceMeter::memory_now() noexcept {
  return {static_cast<std::int64_t>(current_rss_mib() * (1 << 20)), faults(RUSAGE_THREAD),
          faults(RUSAGE_SELF)};
}

void ResourceMeter::look_at_memory() noexcept {
  const Memory now = memory_now();
  const std::int64_t growth = now.resident_bytes - thread_->seen.resident_bytes;
  std::int64_t change = 0;
  if (growth > 0) {
    const std::int64_t own = now.own_faults - thread_->seen.own_faults;
    const std::int64_t all = std::max(own, now.all_faults - thread_->seen.all_faults);
    change = all == 0 ? growth : share(growth, own, all);
  } else if (growth < 0) {
    const std::int64_t all = std::max(thread_->held_bytes, held_by_all.load());
    if (all > 0) change = std::max(share(growth, thread_->held_bytes, all), -thread_->held_bytes);
  }
  thread_->held_bytes += change;
  held_by_all += change;
  account_->memory_bytes_ += change;
  thread_->seen = now;
}

}  // namespace quadrille
