// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include "campaign/jobs/job.hpp"

namespace quadrille::cli::campaign {

/// Which jobs are to be run next, and which no more: ladders, and what has become of their jobs.
class Schedule {
 public:
  /// All ladders, or those numbered. The list has to outlive it.
  explicit Schedule(const JobList& list);
  Schedule(const JobList& list, const std::vector<std::size_t>& ladders);

  /// A job has its row. Jobs of other ladders do not count; a second row of a job changes nothing.
  void finish(std::size_t job, bool solved);

  /// A finished job is to be run again: its ladder goes on from there, if it did not get beyond.
  void reopen(std::size_t job);

  /// The next job, but none of `busy`: lower rungs first, then as in the list.
  [[nodiscard]] std::optional<std::size_t> next(const std::set<std::size_t>& busy) const;
  /// Whether a job is among those that may be run now.
  [[nodiscard]] bool is_open(std::size_t job) const;
  [[nodiscard]] bool is_finished(std::size_t job) const { return states_[job] != State::open; }
  /// Whether it is a job of these ladders.
  [[nodiscard]] bool has(std::size_t job) const { return climb_of_[job] < climbs_.size(); }
  /// Whether ladder number `ladder` has nothing left to run.
  [[nodiscard]] bool is_ladder_done(std::size_t ladder) const;

  struct Counts {
    std::size_t jobs = 0;        ///< Of these ladders.
    std::size_t solved = 0;      ///< Finished.
    std::size_t unsolved = 0;    ///< Finished.
    std::size_t not_needed = 0;  ///< Above the last rungs.
    std::size_t left = 0;        ///< Open, at most: ladders may end before.
    double expected = 0;         ///< As left, but with ladders that end where others have ended.
    std::size_t open_ladders = 0;
  };
  [[nodiscard]] Counts count() const;

 private:
  enum class State { open, solved, unsolved };
  struct Climb {
    std::size_t ladder;
    std::size_t rung = 0;
    std::size_t unsolved = 0;  // of this rung
    bool closed = false;
  };
  void advance(Climb& climb) const;

  const JobList* list_;
  std::vector<State> states_;          // by job
  std::vector<std::size_t> climb_of_;  // by job; the number of climbs if it is in none
  std::vector<Climb> climbs_;
};

}  // namespace quadrille::cli::campaign
