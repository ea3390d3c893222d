// SPDX-License-Identifier: MIT
#include "campaign/run/schedule.hpp"

#include <algorithm>
#include <numeric>

namespace quadrille::cli::campaign {
namespace {

std::vector<std::size_t> all_ladders(const JobList& list) {
  std::vector<std::size_t> ladders(list.ladders.size());
  std::iota(ladders.begin(), ladders.end(), std::size_t{0});
  return ladders;
}

}  // namespace

Schedule::Schedule(const JobList& list) : Schedule(list, all_ladders(list)) {}

Schedule::Schedule(const JobList& list, const std::vector<std::size_t>& ladders)
    : list_(&list),
      states_(list.jobs.size(), State::open),
      climb_of_(list.jobs.size(), ladders.size()) {
  for (const std::size_t ladder : ladders) {
    for (const auto& rung : list.ladders[ladder].rungs)
      for (const std::size_t job : rung) climb_of_[job] = climbs_.size();
    climbs_.push_back({ladder});
  }
}

void Schedule::finish(std::size_t job, bool solved) {
  if (states_[job] != State::open) return;
  states_[job] = solved ? State::solved : State::unsolved;
  if (climb_of_[job] < climbs_.size()) advance(climbs_[climb_of_[job]]);
}

void Schedule::reopen(std::size_t job) {
  states_[job] = State::open;
  if (climb_of_[job] == climbs_.size()) return;
  Climb& climb = climbs_[climb_of_[job]];
  climb = {climb.ladder};
  advance(climb);
}

/// As far as the finished jobs say. Rows may come in any order.
void Schedule::advance(Climb& climb) const {
  const Ladder& ladder = list_->ladders[climb.ladder];
  while (!climb.closed) {
    climb.unsolved = 0;
    bool all = true;
    for (const std::size_t job : ladder.rungs[climb.rung]) {
      if (states_[job] == State::unsolved) ++climb.unsolved;
      all = all && states_[job] != State::open;
    }
    if (climb.unsolved > ladder.allowed)
      climb.closed = true;
    else if (!all)
      return;
    else if (++climb.rung == ladder.rungs.size())
      climb.closed = true;
  }
}

std::optional<std::size_t> Schedule::next(const std::set<std::size_t>& busy) const {
  std::optional<std::size_t> best;
  std::size_t best_level = 0;
  for (const Climb& climb : climbs_) {
    if (climb.closed) continue;
    const Ladder& ladder = list_->ladders[climb.ladder];
    const std::size_t level = ladder.level + climb.rung;
    if (best && level >= best_level) continue;
    for (const std::size_t job : ladder.rungs[climb.rung])
      if (states_[job] == State::open && !busy.contains(job)) {
        best = job;
        best_level = level;
        break;
      }
  }
  return best;
}

bool Schedule::is_open(std::size_t job) const {
  if (states_[job] != State::open || climb_of_[job] >= climbs_.size()) return false;
  const Climb& climb = climbs_[climb_of_[job]];
  if (climb.closed) return false;
  const auto& rung = list_->ladders[climb.ladder].rungs[climb.rung];
  return std::find(rung.begin(), rung.end(), job) != rung.end();
}

bool Schedule::is_ladder_done(std::size_t ladder) const {
  return std::all_of(climbs_.begin(), climbs_.end(),
                     [&](const Climb& climb) { return climb.ladder != ladder || climb.closed; });
}

Schedule::Counts Schedule::count() const {
  Counts counts;
  double closed = 0, share = 0;  // of their rungs, where ladders of several have ended
  for (const Climb& climb : climbs_) {
    const auto& rungs = list_->ladders[climb.ladder].rungs;
    if (climb.closed && rungs.size() > 1) {
      closed += 1;
      share += static_cast<double>(std::min(climb.rung + 1, rungs.size())) /
               static_cast<double>(rungs.size());
    }
    if (!climb.closed) ++counts.open_ladders;
  }
  const double usual = closed > 0 ? share / closed : 1;
  for (const Climb& climb : climbs_) {
    const auto& rungs = list_->ladders[climb.ladder].rungs;
    std::size_t left = 0;
    for (std::size_t r = 0; r < rungs.size(); ++r)
      for (const std::size_t job : rungs[r]) {
        ++counts.jobs;
        if (states_[job] == State::solved) ++counts.solved;
        if (states_[job] == State::unsolved) ++counts.unsolved;
        if (states_[job] != State::open) continue;
        if (climb.closed)
          ++counts.not_needed;
        else
          ++left;
      }
    counts.left += left;
    if (left == 0) continue;
    // At least the rung that is open; at most all.
    const double per_rung = static_cast<double>(rungs[climb.rung].size());
    const double rest =
        (usual * static_cast<double>(rungs.size()) - static_cast<double>(climb.rung)) * per_rung;
    counts.expected += std::clamp(rest, 1.0, static_cast<double>(left));
  }
  return counts;
}

}  // namespace quadrille::cli::campaign
