// SPDX-License-Identifier: MIT
#include "paths/explanation.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

bool can_come(const AgentDistances& d, VertexId goal, Timestep t) {
  bool can = false;
  d.for_each_end(goal, [&](VertexId state) { can = can || d.from_start(state) <= t; });
  return can;
}

}  // namespace

// A walk of cost at most K is one that is at a goal of price p at K - p and meets nothing there
// from then on. So goals that a slot forbids then or later need no more. Let H be the slots that
// blocked a step out of a state that the start can reach within the slack. On any walk to another
// (goal, K - p) the part after the last step that H blocks is found by searching back from (goal, K
// - p) around H, so that step's slot is collected. This search cannot come to a state that the
// start reaches: from there, the walk to the goal would have met a slot of H.
void Explainer::explain(const AgentDistances& d, const ObstacleMap& obstacles,
                        std::span<const Timestep> first_hits, Timestep bound,
                        std::vector<std::size_t>& slots) {
  taken_.assign(obstacles.num_slots(), 0);
  if (seen_.size() < d.states().num_vertices()) seen_.resize(d.states().num_vertices(), 0);
  const Timestep max_slack = bound - d.length();
  // Collects a slot of H from those that `for_each` tells, unless one of them is collected already.
  // False if it tells none.
  const auto collect = [&](const auto& for_each) {
    std::size_t lowest = SIZE_MAX;
    bool covered = false;
    for_each([&](std::uint32_t slot) {
      if (first_hits[slot] > max_slack) return;
      covered = covered || taken_[slot] != 0;
      lowest = std::min<std::size_t>(lowest, slot);
    });
    if (lowest == SIZE_MAX) return false;
    if (!covered) {
      taken_[lowest] = 1;
      slots.push_back(lowest);
    }
    return true;
  };
  const auto is_cut = [&](VertexId v, Timestep t) {
    return collect([&](const auto& tell) { obstacles.for_each_at(v, t, tell); });
  };
  if (d.leaves())
    begin_with_arrivals(d, bound, is_cut);
  else
    cut_off_blocked_goals(d, obstacles, bound, slots);
  if (ends_.empty()) return;
  std::size_t num_begun = 0;
  for (Timestep t = ends_.front().timestep - 1;
       t >= 0 && (!frontier_.empty() || num_begun < ends_.size()); --t) {
    for (; num_begun < ends_.size() && ends_[num_begun].timestep == t + 1; ++num_begun)
      frontier_.push_back(ends_[num_begun].vertex);
    ++stamp_;
    next_.clear();
    for (const VertexId w : frontier_) {
      const VertexId to = d.place(w);
      const auto step_back = [&](VertexId v) {
        if (d.from_start(v) > t || seen_[v] == stamp_) return;
        const VertexId from = d.place(v);
        if (d.has_bans() && d.is_step_banned(from, to, t)) return;
        if (from != to &&
            collect([&](const auto& tell) { obstacles.for_each_on(from, to, t, tell); }))
          return;
        seen_[v] = stamp_;
        if (d.has_bans() && d.is_banned(from, t)) return;
        if (!is_cut(from, t)) next_.push_back(v);
      };
      step_back(w);
      for (const VertexId v : d.states().predecessors(w)) step_back(v);
    }
    frontier_.swap(next_);
  }
  QUADRILLE_REQUIRE(frontier_.empty(), "an explanation cuts the start off");
}

void Explainer::cut_off_blocked_goals(const AgentDistances& d, const ObstacleMap& obstacles,
                                      Timestep bound, std::vector<std::size_t>& slots) {
  const auto goals = d.goals().vertices();
  is_cut_.assign(goals.size(), 0);
  const auto last_arrival = [&](std::size_t goal) { return bound - d.price(goals[goal]); };
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (d.may_rest_from(goals[k]) > last_arrival(k)) is_cut_[k] = 1;
  for (const ObstacleMap::GoalBlock& block : obstacles.goal_blocks()) {
    if (block.last < last_arrival(block.goal) || is_cut_[block.goal] != 0) continue;
    is_cut_[block.goal] = 1;
    // Others that a collected slot cuts off come right after it.
    if (taken_[block.slot] != 0) continue;
    taken_[block.slot] = 1;
    slots.push_back(block.slot);
  }
  frontier_.clear();
  ends_.clear();
  for (std::size_t k = 0; k < goals.size(); ++k)
    if (is_cut_[k] == 0)
      d.for_each_end(goals[k], [&](VertexId state) {
        if (d.from_start(state) <= last_arrival(k)) ends_.push_back({state, last_arrival(k)});
      });
  std::stable_sort(ends_.begin(), ends_.end(),
                   [](const Visit& a, const Visit& b) { return a.timestep > b.timestep; });
}

template <class IsCut>
void Explainer::begin_with_arrivals(const AgentDistances& d, Timestep bound, const IsCut& is_cut) {
  frontier_.clear();
  ends_.clear();
  for (Timestep t = bound; t >= 0; --t)
    for (const VertexId goal : d.goals().vertices())
      if (!d.is_banned(goal, t) && can_come(d, goal, t) && !is_cut(goal, t))
        d.for_each_end(goal, [&](VertexId state) {
          if (d.from_start(state) <= t) ends_.push_back({state, t});
        });
}

}  // namespace quadrille::discrete
