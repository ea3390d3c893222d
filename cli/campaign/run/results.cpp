// SPDX-License-Identifier: MIT
#include "campaign/run/results.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadrille::cli::campaign {

Follower::Follower(const JobList& list, Store& store, Schedule& schedule)
    : store_(store), schedule_(schedule) {
  for (std::size_t i = 0; i < list.jobs.size(); ++i) numbers_.emplace(list.jobs[i].name, i);
}

void Damage::note(const Store& store, long line, const Error& what) {
  constexpr std::size_t kKept = 20;
  ++lines_;
  if (errors_.size() < kKept) errors_.push_back({what.code, what.message, {store.path(), line}});
}

std::optional<Error> Follower::update(const std::function<void(std::size_t, const Row&)>& take) {
  return store_.read_new([&](std::string_view line, long number) {
    const auto row = read_row(line);
    if (!row) {
      damage_.note(store_, number, row.error());
      return;
    }
    const auto job = numbers_.find(row->job);
    if (job == numbers_.end()) {
      ++foreign_;
      return;
    }
    if (row->opens()) {
      failed_.erase(job->second);
      answered_.erase(job->second);
      schedule_.reopen(job->second);
      if (take) take(job->second, *row);
      return;
    }
    (row->solved() ? times_.solved_s : times_.unsolved_s) += row->wall_s;
    ++(row->solved() ? times_.solved : times_.unsolved);
    if (schedule_.has(job->second))
      (row->status == "failed" ? failed_ : answered_).insert(job->second);
    schedule_.finish(job->second, row->solved());
    if (take) take(job->second, *row);
  });
}

std::optional<double> estimate_s(const Schedule& schedule, const Follower::Times& times,
                                 const JobLimits& limits, std::size_t processes) {
  const Schedule::Counts counts = schedule.count();
  if (counts.left == 0) return 0;
  if (times.solved + times.unsolved == 0) return std::nullopt;
  const double solved = times.solved > 0 ? times.solved_s / static_cast<double>(times.solved) : 0;
  const double limit = limits.wall_s.value_or(limits.cpu_s.value_or(solved));
  const double unsolved =
      times.unsolved > 0 ? times.unsolved_s / static_cast<double>(times.unsolved) : limit;
  // The last job of a ladder is one that is not solved.
  const double last = std::min(static_cast<double>(counts.open_ladders), counts.expected);
  const double work = (counts.expected - last) * solved + last * std::max(solved, unsolved);
  return work / static_cast<double>(std::max<std::size_t>(1, processes));
}

std::string duration_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 90 * 60) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 48 * 3600) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.1f} days", seconds / 86400);
}

}  // namespace quadrille::cli::campaign
