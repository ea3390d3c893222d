// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "answers/progress.hpp"
#include "campaign/run/child.hpp"
#include "campaign/run/results.hpp"
#include "frame/output.hpp"

namespace quadrille::cli::campaign {

struct RunOptions {
  std::size_t processes = 1;
  /// Jobs that others have claimed are waited for, because what comes after them is for us, too;
  /// else the run ends when only such are left.
  bool wait_for_others = true;
  std::string program;  ///< This program, for jobs that name no other.
  const std::atomic<bool>* interrupt = nullptr;
};

/// Runs the jobs of a schedule in processes of their own, and appends their rows.
class Runner {
 public:
  /// All have to outlive it.
  Runner(const JobList& list, Schedule& schedule, Store& store, const RunOptions& options,
         Console& console);

  enum class End {
    complete,  ///< No job is left.
    left,      ///< Interrupted, or others run what is left.
    failed,    ///< `error` says why; no job's fault.
  };
  [[nodiscard]] End run();
  [[nodiscard]] const std::optional<Error>& error() const noexcept { return error_; }
  /// What it has read and written.
  [[nodiscard]] const Follower& follower() const noexcept { return follower_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Active {
    std::size_t job;
    Child child;
  };
  struct Held {
    std::size_t job;
    Ended ended;
  };

  [[nodiscard]] bool interrupted() const { return *options_.interrupt; }
  bool fail(const Error& error);
  bool update();
  /// Starts jobs while there is room. False on an error.
  bool start_jobs();
  bool start(std::size_t job);
  void wait_a_little() const;
  /// Looks after the processes. False on an error.
  bool tend();
  /// Somebody's signal ended a job: nothing is begun until it is certain that it was not for us.
  void hold(std::size_t job, Ended ended);
  /// Decides about the jobs that were held. False on an error.
  bool settle();
  bool settle(std::size_t job, const Ended& ended);
  bool finish(std::size_t job, const Row& row);
  void let_go(std::size_t job);
  void stop_all();
  void report(bool now);

  const JobList& list_;
  Schedule& schedule_;
  Store& store_;
  const RunOptions& options_;
  Console& console_;
  ProgressLine line_;
  Follower follower_;
  std::vector<Active> active_;
  std::vector<Held> held_;
  Clock::time_point held_until_;     // if there are any
  std::set<std::size_t> busy_;       // run by us, or held
  std::set<std::size_t> elsewhere_;  // claimed by others when we last looked
  std::map<std::size_t, int> kills_;
  Clock::time_point reported_ = Clock::now();
  std::optional<Error> error_;
};

}  // namespace quadrille::cli::campaign
