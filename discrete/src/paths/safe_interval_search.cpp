// SPDX-License-Identifier: MIT
#include "paths/safe_interval_search.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace quadrille::discrete {

bool SafeIntervalSearch::find(const AgentDistances& distances, const ObstacleMap& obstacles,
                              Timestep max_cost, std::span<Timestep> first_hits, Path& path) {
  const Query query{distances, obstacles, max_cost, first_hits};
  if (max_cost < distances.length() || obstacles.least_cost() > max_cost) return false;
  start_search(distances);
  const VertexId start = distances.start_state();
  add(query, start, intervals_of(query, start).begin, 0, kNoLabel);
  // The cheapest end that was come to.
  std::optional<std::pair<std::size_t, LabelIndex>> end;
  for (std::size_t slack = 0; slack < open_.size() && !(end && end->first <= slack); ++slack) {
    while (!open_[slack].empty()) {
      const LabelIndex label = open_[slack].back();
      open_[slack].pop_back();
      const Label at = labels_[label];
      if (intervals_[at.interval].arrival < at.time) continue;
      if (is_end(query, at)) {
        const auto then =
            static_cast<std::size_t>(distances.end_slack(at.vertex, static_cast<Timestep>(slack)));
        if (!end || then < end->first) end = {then, label};
        if (then == slack) break;
      }
      ++effort_;
      if (limits_ != nullptr && effort_ % 64 == 0) limits_->check();
      expand(query, label);
    }
  }
  if (!end || static_cast<Timestep>(end->first) > max_cost - distances.length()) return false;
  path = path_to(labels_, end->second);
  return true;
}

bool SafeIntervalSearch::is_end(const Query& query, const Label& label) const {
  if (!query.distances.is_goal(label.state)) return false;
  if (query.distances.leaves()) return true;
  return intervals_[label.interval].end == kForever &&
         query.obstacles.earliest_rest(label.vertex) != kForever;
}

void SafeIntervalSearch::start_search(const AgentDistances& distances) {
  if (heads_.size() < distances.states().num_vertices())
    heads_.resize(distances.states().num_vertices());
  if (++stamp_ == 0) {
    heads_.assign(heads_.size(), {});
    stamp_ = 1;
  }
  intervals_.clear();
  labels_.clear();
  for (auto& bucket : open_) bucket.clear();
}

SafeIntervalSearch::Head SafeIntervalSearch::intervals_of(const Query& query, VertexId state) {
  const VertexId v = query.distances.place(state);
  Head& head = heads_[state];
  if (head.stamp == stamp_) return head;
  const auto begin = static_cast<std::uint32_t>(intervals_.size());
  visits_.clear();
  // Nobody steps anywhere at timestep 0.
  const auto close = [&](Timestep first, Timestep last) {
    if (last > 0) visits_.emplace_back(std::max<Timestep>(first, 1), last);
  };
  query.obstacles.for_each_visit(
      v, [&](Timestep first, Timestep last, std::uint32_t) { close(first, last); });
  query.distances.for_each_ban(v, close);
  std::sort(visits_.begin(), visits_.end());
  Timestep from = 0;  // What lies before it was dealt with.
  for (const auto& [first, last] : visits_) {
    if (first > from) intervals_.push_back({from, first - 1, kForever});
    from = last == kForever ? kForever : std::max(from, last + 1);
    if (from == kForever) break;
  }
  if (from != kForever) intervals_.push_back({from, kForever, kForever});
  head = {stamp_, begin, static_cast<std::uint32_t>(intervals_.size())};
  return head;
}

void SafeIntervalSearch::add(const Query& query, VertexId state, std::uint32_t interval,
                             Timestep time, LabelIndex parent) {
  if (intervals_[interval].arrival <= time) return;
  intervals_[interval].arrival = time;
  const auto slack = static_cast<std::size_t>(query.distances.slack(state, time));
  if (slack >= open_.size()) open_.resize(slack + 1);
  open_[slack].push_back(static_cast<LabelIndex>(labels_.size()));
  labels_.push_back({query.distances.place(state), interval, time, parent, state});
}

void SafeIntervalSearch::hit(const Query& query, std::uint32_t slot, VertexId state, Timestep t) {
  Timestep& first = query.first_hits[slot];
  first = std::min(first, query.distances.slack(state, t));
}

void SafeIntervalSearch::expand(const Query& query, LabelIndex from) {
  const VertexId v = labels_[from].state;
  const Timestep end = intervals_[labels_[from].interval].end;
  if (!query.first_hits.empty() && end < query.max_cost - query.distances.to_goal(v))
    query.obstacles.for_each_at(labels_[from].vertex, end + 1,
                                [&](std::uint32_t slot) { hit(query, slot, v, end + 1); });
  for (const VertexId w : query.distances.states().neighbours(v))
    if (query.distances.to_goal(w) != kUnreachable) reach(query, from, w);
}

/// Adds the earliest arrival in each interval of a neighbour that can be reached from the rest of
/// the label's interval.
void SafeIntervalSearch::reach(const Query& query, LabelIndex from, VertexId to) {
  const Label label = labels_[from];
  const Timestep first = label.time + 1;
  const Timestep last =
      std::min(intervals_[label.interval].end, query.max_cost - query.distances.to_goal(to) - 1) +
      1;
  if (first > last) return;
  const VertexId there = query.distances.place(to);
  if (!query.first_hits.empty()) {
    query.obstacles.for_each_visit(there, [&](Timestep begin, Timestep end, std::uint32_t slot) {
      if (begin <= last && end >= first) hit(query, slot, to, std::max(begin, first));
    });
    query.obstacles.for_each_move(label.vertex, there, [&](Timestep t, std::uint32_t slot) {
      if (first <= t + 1 && t + 1 <= last) hit(query, slot, to, t + 1);
    });
  }
  const auto is_blocked = [&](Timestep t) {
    bool blocked = false;
    query.obstacles.for_each_on(label.vertex, there, t, [&](std::uint32_t) { blocked = true; });
    return blocked;
  };
  const Head head = intervals_of(query, to);
  const auto reachable =
      std::partition_point(intervals_.begin() + head.begin, intervals_.begin() + head.end,
                           [&](const Interval& interval) { return interval.end < first; });
  for (auto k = static_cast<std::uint32_t>(reachable - intervals_.begin()); k != head.end; ++k) {
    const Interval interval = intervals_[k];
    if (interval.begin > last) return;
    Timestep arrival = std::max(first, interval.begin);
    const Timestep latest = std::min(last, interval.end);
    // Obstacles forbid single moves, rules perhaps for ever.
    const auto next = [&](Timestep t) {
      const Timestep begin = query.distances.next_move(label.vertex, there, t - 1);
      return begin == kForever ? kForever : begin + 1;
    };
    for (arrival = next(arrival); arrival <= latest && is_blocked(arrival - 1);)
      arrival = next(arrival + 1);
    if (arrival <= latest) add(query, to, k, arrival, from);
  }
}

}  // namespace quadrille::discrete
