// SPDX-License-Identifier: MIT
#include "quadrille/core/limits.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <utility>

namespace quadrille {

double wall_seconds() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() noexcept {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_rss_mib() noexcept {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double current_rss_mib() noexcept {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  long total = 0, resident = 0;
  const int fields = std::fscanf(file, "%ld %ld", &total, &resident);
  std::fclose(file);
  if (fields != 2) return 0;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

LimitMonitor::LimitMonitor(const Limits& limits)
    : limits_(limits), wall_start_(wall_seconds()), cpu_start_(cpu_seconds()) {}

double LimitMonitor::elapsed_wall() const noexcept { return wall_seconds() - wall_start_; }
double LimitMonitor::elapsed_cpu() const noexcept { return cpu_seconds() - cpu_start_; }

void LimitMonitor::set_ticker(double interval_s, std::function<void()> listener) {
  ticker_ = std::move(listener);
  tick_interval_ = interval_s;
  next_tick_ = elapsed_wall() + interval_s;
}

void LimitMonitor::set_conflict_listener(std::function<void()> listener) {
  conflict_listener_ = std::move(listener);
}

void LimitMonitor::add_conflicts(std::int64_t count) {
  conflicts_ += count;
  if (conflict_listener_) conflict_listener_();
}

void LimitMonitor::stop(StopReason reason) noexcept {
  if (reason_ == StopReason::none) reason_ = reason;
}

bool LimitMonitor::exhausted() {
  if (reason_ != StopReason::none) return true;
  ++calls_;
  if (ticker_ && calls_ % 16 == 0 && elapsed_wall() >= next_tick_) {
    ticker_();
    next_tick_ = elapsed_wall() + tick_interval_;
  }
  if (limits_.interrupt != nullptr && limits_.interrupt->load(std::memory_order_relaxed))
    reason_ = StopReason::interrupt;
  else if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed))
    reason_ = StopReason::interrupt;
  else if (limits_.conflicts && conflicts_ >= *limits_.conflicts)
    reason_ = StopReason::conflicts;
  else if (calls_ % 16 == 0 && limits_.wall_s && elapsed_wall() >= *limits_.wall_s)
    reason_ = StopReason::wall_time;
  else if (calls_ % 16 == 0 && limits_.cpu_s && elapsed_cpu() >= *limits_.cpu_s)
    reason_ = StopReason::cpu_time;
  else if (calls_ % 1024 == 0 && limits_.memory_mib && current_rss_mib() >= *limits_.memory_mib)
    reason_ = StopReason::memory;
  return reason_ != StopReason::none;
}

bool LimitMonitor::exhausted_now() {
  calls_ = 1023;
  return exhausted();
}

}  // namespace quadrille
