// SPDX-License-Identifier: MIT
#include "paths/safe_interval_search.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace quadrille::discrete {

bool SafeIntervalSearch::find(const AgentDistances& distances, const ObstacleMap& obstacles,
                              Timestep max_cost, std::span<Timestep> first_hits, Path& path) {
  const Query query{distances, obstacles, max_cost, first_hits};
  if (max_cost < distances.free_cost() || obstacles.least_cost() > max_cost) return false;
  start_search();
  add(query, distances.start(), intervals_of(query, distances.start()).begin, 0, kNoLabel);
  // The cheapest end that was come to.
  std::optional<std::pair<std::size_t, LabelIndex>> end;
  for (std::size_t slack = 0; slack < open_.size() && !(end && end->first <= slack); ++slack) {
    while (!open_[slack].empty()) {
      const LabelIndex label = open_[slack].back();
      open_[slack].pop_back();
      const auto [vertex, interval, time, parent] = labels_[label];
      if (intervals_[interval].arrival < time) continue;
      if (intervals_[interval].end == kForever && distances.is_goal(vertex) &&
          obstacles.earliest_rest(vertex) != kForever) {
        const auto then =
            static_cast<std::size_t>(distances.end_slack(vertex, static_cast<Timestep>(slack)));
        if (!end || then < end->first) end = {then, label};
        if (then == slack) break;
      }
      ++effort_;
      if (limits_ != nullptr && effort_ % 64 == 0) limits_->check();
      expand(query, label);
    }
  }
  if (!end || static_cast<Timestep>(end->first) > max_cost - distances.free_cost()) return false;
  path = path_to(labels_, end->second);
  return true;
}

void SafeIntervalSearch::start_search() {
  if (++stamp_ == 0) {
    heads_.assign(heads_.size(), {});
    stamp_ = 1;
  }
  intervals_.clear();
  labels_.clear();
  for (auto& bucket : open_) bucket.clear();
}

SafeIntervalSearch::Head SafeIntervalSearch::intervals_of(const Query& query, VertexId v) {
  Head& head = heads_[v];
  if (head.stamp == stamp_) return head;
  const auto begin = static_cast<std::uint32_t>(intervals_.size());
  visits_.clear();
  // Nobody steps anywhere at timestep 0.
  query.obstacles.for_each_visit(v, [&](Timestep first, Timestep last, std::uint32_t) {
    if (last > 0) visits_.emplace_back(std::max<Timestep>(first, 1), last);
  });
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

void SafeIntervalSearch::add(const Query& query, VertexId v, std::uint32_t interval, Timestep time,
                             LabelIndex parent) {
  if (intervals_[interval].arrival <= time) return;
  intervals_[interval].arrival = time;
  const auto slack = static_cast<std::size_t>(query.distances.slack(v, time));
  if (slack >= open_.size()) open_.resize(slack + 1);
  open_[slack].push_back(static_cast<LabelIndex>(labels_.size()));
  labels_.push_back({v, interval, time, parent});
}

void SafeIntervalSearch::hit(const Query& query, std::uint32_t slot, VertexId v, Timestep t) {
  Timestep& first = query.first_hits[slot];
  first = std::min(first, query.distances.slack(v, t));
}

void SafeIntervalSearch::expand(const Query& query, LabelIndex from) {
  const VertexId v = labels_[from].vertex;
  const Timestep end = intervals_[labels_[from].interval].end;
  if (end < query.max_cost - query.distances.to_goal(v))
    query.obstacles.for_each_at(v, end + 1,
                                [&](std::uint32_t slot) { hit(query, slot, v, end + 1); });
  for (const VertexId w : query.distances.graph().neighbours(v)) reach(query, from, w);
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
  query.obstacles.for_each_visit(to, [&](Timestep begin, Timestep end, std::uint32_t slot) {
    if (begin <= last && end >= first) hit(query, slot, to, std::max(begin, first));
  });
  query.obstacles.for_each_move(label.vertex, to, [&](Timestep t, std::uint32_t slot) {
    if (first <= t + 1 && t + 1 <= last) hit(query, slot, to, t + 1);
  });
  const auto is_blocked = [&](Timestep t) {
    bool blocked = false;
    query.obstacles.for_each_on(label.vertex, to, t, [&](std::uint32_t) { blocked = true; });
    return blocked;
  };
  const Head head = intervals_of(query, to);
  for (std::uint32_t k = head.begin; k != head.end; ++k) {
    const Interval interval = intervals_[k];
    if (interval.begin > last) return;
    if (interval.end < first) continue;
    Timestep arrival = std::max(first, interval.begin);
    const Timestep latest = std::min(last, interval.end);
    while (arrival <= latest && is_blocked(arrival - 1)) ++arrival;
    if (arrival <= latest) add(query, to, k, arrival, from);
  }
}

}  // namespace quadrille::discrete
