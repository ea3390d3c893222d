// SPDX-License-Identifier: MIT
#pragma once

#include <sys/time.h>

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace quadrille::support {

/// Turns a computation without end into an abort: see AbortNote. Counts CPU time. One at a time.
class Patience {
 public:
  explicit Patience(std::time_t cpu_s) {
    std::signal(SIGVTALRM, [](int) { std::abort(); });
    set(cpu_s);
  }
  ~Patience() { set(0); }
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

 private:
  static void set(std::time_t cpu_s) {
    itimerval timer{};
    timer.it_value.tv_sec = cpu_s;
    setitimer(ITIMER_VIRTUAL, &timer, nullptr);
  }
};

}  // namespace quadrille::support
