// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "campaign/jobs/manifest.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// Which limit was enforced from outside.
enum class Enforced { no, cpu_time, wall_time, memory };

/// How a process ended.
struct Ended {
  int code = -1;   ///< Exit code; -1 if a signal ended it.
  int signal = 0;  ///< The signal, or 0.
  Enforced enforced = Enforced::no;
  double cpu_s = 0;  ///< User and system time of the whole process.
  double wall_s = 0;
  double peak_rss_mib = 0;
  std::string out, err;  ///< What it wrote; of errors the last 4000 bytes.
};

/// A process whose limits are enforced from outside: CPU time by the system (RLIMIT_CPU),
/// wall-clock time and memory by who calls `watch` often enough. It dies with the process that
/// started it.
class Child {
 public:
  /// Errors (io): the program cannot be started. `program` is looked for as the shell does.
  [[nodiscard]] static Result<Child> start(const std::string& program,
                                           const std::vector<std::string>& arguments,
                                           const JobLimits& limits);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  ~Child();  ///< Kills it if it still runs.

  /// Takes what it has written, ends it if it has broken a limit, and says how it ended if it has.
  [[nodiscard]] std::optional<Ended> watch();
  /// Asks it to end, and kills it after the grace time.
  void stop();
  /// The files to wait for, -1 if closed.
  [[nodiscard]] int out_file() const { return out_; }
  [[nodiscard]] int err_file() const { return err_; }

 private:
  using Clock = std::chrono::steady_clock;

  Child() = default;
  void read_streams();
  void enforce();

  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  Clock::time_point began_;
  std::optional<Clock::time_point> kill_at_;  // once it was asked to end
  JobLimits limits_;
  Ended ended_;
};

}  // namespace quadrille::cli::campaign
