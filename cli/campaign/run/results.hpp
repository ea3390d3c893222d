// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "campaign/jobs/job.hpp"
#include "campaign/run/row.hpp"
#include "campaign/run/schedule.hpp"
#include "campaign/run/store.hpp"

namespace quadrille::cli::campaign {

/// The files of a campaign in its folder.
struct Folder {
  std::filesystem::path path;

  [[nodiscard]] std::filesystem::path jobs() const { return path / "jobs.json"; }
  [[nodiscard]] std::filesystem::path results() const { return path / "results.jsonl"; }
  [[nodiscard]] std::filesystem::path merged() const { return path / "merged"; }
  [[nodiscard]] std::filesystem::path slurm() const { return path / "slurm"; }
};

/// Lines of the store that are no rows. Their jobs are run again.
class Damage {
 public:
  /// `what`: why the line is none.
  void note(const Store& store, long line, const Error& what);
  [[nodiscard]] std::size_t lines() const noexcept { return lines_; }
  /// The first ones, with file and line.
  [[nodiscard]] const std::vector<Error>& errors() const noexcept { return errors_; }

 private:
  std::size_t lines_ = 0;
  std::vector<Error> errors_;
};

/// Follows the file of results, and keeps a schedule up to date with it.
class Follower {
 public:
  /// All three have to outlive it.
  Follower(const JobList& list, Store& store, Schedule& schedule);

  /// Reads what is new. `take` hears of each row of the list's jobs, and its job; also of those
  /// that open a job again.
  std::optional<Error> update(const std::function<void(std::size_t, const Row&)>& take = {});

  [[nodiscard]] const Damage& damage() const noexcept { return damage_; }
  /// Whether jobs of the schedule have rows, and all of these say that the job failed.
  [[nodiscard]] bool all_failed() const noexcept { return !failed_.empty() && answered_.empty(); }
  /// Rows of jobs that the list does not have: of an earlier manifest.
  [[nodiscard]] std::size_t foreign() const noexcept { return foreign_; }
  /// Seconds that jobs took: all solved ones, and all others.
  struct Times {
    double solved_s = 0, unsolved_s = 0;
    std::size_t solved = 0, unsolved = 0;
  };
  [[nodiscard]] const Times& times() const noexcept { return times_; }

 private:
  Store& store_;
  Schedule& schedule_;
  std::map<std::string, std::size_t> numbers_;
  Damage damage_;
  std::size_t foreign_ = 0;
  std::set<std::size_t> failed_, answered_;  // jobs of the schedule
  Times times_;
};

/// A guess at the seconds that are left with this number of processes; nullopt as long as nothing
/// is known.
[[nodiscard]] std::optional<double> estimate_s(const Schedule& schedule,
                                               const Follower::Times& times,
                                               const JobLimits& limits, std::size_t processes);
/// "42 s", "17 min", "3.5 h", "2.1 days"
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace quadrille::cli::campaign
