// SPDX-License-Identifier: MIT
#include "quadrille/core/limits.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>
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

double thread_cpu_seconds() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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

LimitMonitor::LimitMonitor(const Limits& limits, std::shared_ptr<ResourceAccount> account)
    : limits_(limits), meter_(account ? std::move(account) : std::make_shared<ResourceAccount>()) {}

double LimitMonitor::elapsed_wall() const noexcept { return meter_.account().wall_s(); }
double LimitMonitor::elapsed_cpu() noexcept {
  meter_.look_at_cpu();
  return meter_.account().cpu_s();
}

void LimitMonitor::stop(StopReason reason) noexcept {
  if (reason_ == StopReason::none) reason_ = reason;
}

bool LimitMonitor::exhausted() {
  if (!look() && calls_ % 16 == 0) look_at_meter(false);
  return reason_ != StopReason::none;
}

bool LimitMonitor::exhausted_now() {
  if (!look()) look_at_meter(true);
  return reason_ != StopReason::none;
}

bool LimitMonitor::look() {
  ++calls_;
  if (reason_ != StopReason::none) return true;
  if (limits_.interrupt != nullptr && limits_.interrupt->load(std::memory_order_relaxed))
    reason_ = StopReason::interrupt;
  else if (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed))
    reason_ = StopReason::interrupt;
  else if (limits_.conflicts && conflicts_ >= *limits_.conflicts)
    reason_ = StopReason::conflicts;
  else if (limits_.looks && calls_ >= *limits_.looks)
    reason_ = StopReason::interrupt;
  return reason_ != StopReason::none;
}

void LimitMonitor::look_at_meter(bool at_cpu) {
  constexpr double kInterval = 0.001;
  const double now = elapsed_wall();
  const bool is_due = now >= next_look_;
  if (is_due) next_look_ = now + kInterval;
  if (is_due && limits_.memory_mib) meter_.look_at_memory();
  if (limits_.wall_s && now >= *limits_.wall_s)
    stop(StopReason::wall_time);
  else if ((is_due || at_cpu) && limits_.cpu_s && elapsed_cpu() >= *limits_.cpu_s)
    stop(StopReason::cpu_time);
  else if (limits_.memory_mib && meter_.account().memory_mib() >= *limits_.memory_mib)
    stop(StopReason::memory);
  if (pulse_ && num_quiet_ == 0 && reason_ == StopReason::none) pulse_();
}

bool LimitMonitor::has_room_for(std::size_t bytes) {
  if (look()) return false;
  if (!limits_.memory_mib) return true;
  meter_.look_at_memory();
  const double more = static_cast<double>(bytes) / (1 << 20);
  if (meter_.account().memory_mib() + more > *limits_.memory_mib) stop(StopReason::memory);
  return reason_ == StopReason::none;
}

void LimitMonitor::check() {
  if (exhausted()) throw LimitReached{};
}

void LimitMonitor::check_room_for(std::size_t bytes) {
  if (!has_room_for(bytes)) throw LimitReached{};
}

}  // namespace quadrille
