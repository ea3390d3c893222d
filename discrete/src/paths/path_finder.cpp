// SPDX-License-Identifier: MIT
#include "paths/path_finder.hpp"

#include <algorithm>
#include <optional>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {
/// Timesteps from a free arrival to the end of the last passage of the goal.
constexpr Timestep kLate = 8;
/// Efforts after which paths with few collisions are no longer looked for.
constexpr std::int64_t kStatesPerVertex = 4, kStatesPerStep = 10;
}  // namespace

void PathFinder::start_search(const AgentDistances& distances) {
  if (heads_.size() < distances.states().num_vertices())
    heads_.resize(distances.states().num_vertices());
  if (++stamp_ == 0) {
    heads_.assign(heads_.size(), {});
    stamp_ = 1;
  }
  closed_.clear();
  for (Buckets& buckets : open_)
    for (auto& bucket : buckets) bucket.clear();
}

void PathFinder::push(Buckets& buckets, Timestep at, State state) {
  const auto index = static_cast<std::size_t>(at);
  if (buckets.size() <= index) buckets.resize(index + 1);
  buckets[index].push_back(state);
}

bool PathFinder::is_closed(VertexId v, Timestep slack) const {
  const Head& head = heads_[v];
  if (head.stamp != stamp_ || head.largest < slack) return false;
  if (head.largest == slack) return true;
  ClosedIndex at = head.last;
  while (at != kNone && closed_[at].slack != slack) at = closed_[at].earlier;
  return at != kNone;
}

PathFinder::ClosedIndex PathFinder::close(State state, Timestep slack) {
  if (limits_ != nullptr && closed_.size() == closed_.capacity())
    limits_->check_room_for(2 * closed_.size() * sizeof(Closed));
  Head& head = heads_[state.vertex];
  if (head.stamp != stamp_) head = {stamp_, -1, kNone};
  const auto index = static_cast<ClosedIndex>(closed_.size());
  closed_.push_back({state, slack, head.last});
  head.largest = std::max(head.largest, slack);
  head.last = index;
  return index;
}

void PathFinder::trace(const Query& query, ClosedIndex last, Path& path) const {
  const Timestep arrival = query.distances.time(closed_[last].state.vertex, closed_[last].slack);
  path.resize(static_cast<std::size_t>(arrival) + 1);
  ClosedIndex at = last;
  for (auto vertex = path.rbegin(); vertex != path.rend(); ++vertex) {
    QUADRILLE_REQUIRE(at != kNone, "a path begins at timestep 0");
    *vertex = query.distances.place(closed_[at].state.vertex);
    at = closed_[at].state.parent;
  }
  QUADRILLE_REQUIRE(at == kNone && path[0] == query.distances.start(),
                    "a path begins at the start");
}

template <class Hit, class Push>
void PathFinder::expand(const Query& query, VertexId v, Timestep slack, const Hit& hit,
                        const Push& push) {
  ++effort_;
  if (limits_ != nullptr && effort_ % 64 == 0) limits_->check();
  const AgentDistances& d = query.distances;
  const Timestep max_slack = query.max_cost - d.length();
  const Timestep h = d.to_goal(v), t = d.time(v, slack);
  const VertexId from = d.place(v);
  const auto step = [&](VertexId state, Timestep slack_then) {
    if (slack_then > max_slack) return;
    if (is_closed(state, slack_then)) return;
    const VertexId w = d.place(state);
    if (d.has_bans() && d.is_step_banned(from, w, t)) return;
    bool blocked = false;
    const auto note = [&](std::uint32_t slot) {
      blocked = true;
      hit(slot, slack_then);
    };
    query.obstacles.for_each_at(w, t + 1, note);
    if (!blocked && w != from) query.obstacles.for_each_on(from, w, t, note);
    if (!blocked) push(state, slack_then, t + 1);
  };
  step(v, slack + 1);
  for (const VertexId w : d.states().neighbours(v))
    if (const Timestep then = d.to_goal(w); then != kUnreachable) step(w, slack + 1 + then - h);
}

bool PathFinder::find_cheapest(const Query& query, Path& path) {
  const AgentDistances& d = query.distances;
  first_hits_.assign(query.obstacles.num_slots(), kNoHit);
  const Timestep least_cost = query.obstacles.least_cost();
  if (std::max(d.free_cost(), least_cost) > query.max_cost) return false;
  if (least_cost - d.length() >= kLate) {
    if (!d.has_prices() && dive(query, path)) return true;
  } else {
    const auto enough = kStatesPerVertex * static_cast<std::int64_t>(heads_.size());
    if (const End end = sweep(query, enough, path); end != End::gave_up) return end == End::found;
  }
  return safe_intervals_.find(d, query.obstacles, query.max_cost, first_hits_, path);
}

PathFinder::End PathFinder::sweep(const Query& query, std::int64_t max_effort, Path& path) {
  const AgentDistances& d = query.distances;
  const std::int64_t last_effort = effort_ + max_effort;
  const Timestep ring = d.largest_step() + 1;  // Steps from one slack end in these, all different.
  if (open_.size() < static_cast<std::size_t>(ring)) open_.resize(static_cast<std::size_t>(ring));
  start_search(d);
  const Timestep max_slack = query.max_cost - d.length();
  push(open_[0], 0, {d.start_state(), kNone});
  // The cheapest end that was come to, at a goal that is dear.
  std::optional<std::pair<Timestep, ClosedIndex>> end;
  for (Timestep slack = 0; slack <= max_slack; ++slack) {
    if (end && end->first <= slack) {
      trace(query, end->second, path);
      return End::found;
    }
    Buckets& buckets = open_[static_cast<std::size_t>(slack % ring)];
    for (std::size_t c = 0; c < buckets.size(); ++c) {
      while (!buckets[c].empty()) {
        const State state = buckets[c].back();
        buckets[c].pop_back();
        if (is_closed(state.vertex, slack)) continue;
        if (effort_ >= last_effort) return End::gave_up;
        const ClosedIndex index = close(state, slack);
        if (d.is_goal(state.vertex) &&
            d.time(state.vertex, slack) >= query.obstacles.earliest_rest(d.place(state.vertex))) {
          const Timestep then = d.end_slack(d.place(state.vertex), slack);
          if (then == slack) {
            trace(query, index, path);
            return End::found;
          }
          if (!end || then < end->first) end = {then, index};
        }
        expand(
            query, state.vertex, slack,
            [&](std::uint32_t slot, Timestep then) {
              first_hits_[slot] = std::min(first_hits_[slot], then);
            },
            [&](VertexId w, Timestep then, Timestep arrival) {
              const int more = query.others == nullptr
                                   ? 0
                                   : query.others->collisions_of_step(
                                         query.agent, d.place(state.vertex), d.place(w), arrival);
              push(open_[static_cast<std::size_t>(then % ring)], static_cast<Timestep>(c) + more,
                   {w, index});
            });
      }
    }
  }
  return End::none;
}

bool PathFinder::dive(const Query& query, Path& path) {
  const AgentDistances& d = query.distances;
  const Timestep arrival = query.obstacles.least_cost();
  const Query bounded{query.agent, d, query.obstacles, arrival, query.others};
  const std::int64_t last_effort = effort_ + kStatesPerStep * (std::int64_t{arrival} + 1);
  if (open_.empty()) open_.resize(1);
  start_search(d);
  Buckets& buckets = open_[0];  // by collisions; last in, first out
  push(buckets, 0, {d.start_state(), kNone});
  for (std::size_t c = 0; c < buckets.size(); ++c) {
    while (!buckets[c].empty()) {
      if (effort_ >= last_effort) return false;
      const State state = buckets[c].back();
      buckets[c].pop_back();
      const Timestep slack = state.parent == kNone ? 0 : slack_after(d, state);
      if (is_closed(state.vertex, slack)) continue;
      const ClosedIndex index = close(state, slack);
      if (d.length() + slack == arrival && d.is_goal(state.vertex) &&
          query.obstacles.earliest_rest(d.place(state.vertex)) <= arrival) {
        trace(query, index, path);
        return true;
      }
      steps_.clear();
      expand(
          bounded, state.vertex, slack, [](std::uint32_t, Timestep) {},
          [&](VertexId w, Timestep then, Timestep) { steps_.emplace_back(then, w); });
      // Of the steps the one with the least slack comes first, a wait last.
      std::stable_sort(steps_.begin(), steps_.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      for (const auto& [then, w] : steps_) {
        const Timestep at = d.time(w, then);
        const int more = query.others == nullptr
                             ? 0
                             : query.others->collisions_of_step(query.agent, d.place(state.vertex),
                                                                d.place(w), at);
        push(buckets, static_cast<Timestep>(c) + more, {w, index});
      }
    }
  }
  return false;
}

Timestep PathFinder::slack_after(const AgentDistances& d, State state) const {
  const Closed& before = closed_[state.parent];
  return before.slack + 1 + d.to_goal(state.vertex) - d.to_goal(before.state.vertex);
}

bool PathFinder::find_quietest(const Query& query, int below, Path& path) {
  QUADRILLE_REQUIRE(query.others != nullptr, "collisions with somebody");
  const std::int64_t last_effort =
      query.max_effort > INT64_MAX - effort_ ? INT64_MAX : effort_ + query.max_effort;
  const AgentDistances& d = query.distances;
  if (query.max_cost < d.length() || query.obstacles.least_cost() > query.max_cost) return false;
  if (static_cast<int>(open_.size()) < below) open_.resize(static_cast<std::size_t>(below));
  start_search(d);
  if (below <= 0) return false;
  push(open_[0], 0, {d.start_state(), kNone});
  for (int c = 0; c < below; ++c) {
    Buckets& buckets = open_[static_cast<std::size_t>(c)];
    for (std::size_t s = 0; s < buckets.size(); ++s) {  // steps never lessen the slack
      while (!buckets[s].empty()) {
        if (effort_ >= last_effort) return false;
        const State state = buckets[s].back();
        buckets[s].pop_back();
        const auto slack = static_cast<Timestep>(s);
        if (is_closed(state.vertex, slack)) continue;
        const ClosedIndex index = close(state, slack);
        const Timestep arrival = d.time(state.vertex, slack);
        const VertexId here = d.place(state.vertex);
        if (d.is_goal(state.vertex) && arrival >= query.obstacles.earliest_rest(here) &&
            d.length() + d.end_slack(here, slack) <= query.max_cost &&
            c + query.others->collisions_of_rest(query.agent, here, arrival) < below) {
          trace(query, index, path);
          return true;
        }
        expand(
            query, state.vertex, slack, [](std::uint32_t, Timestep) {},
            [&](VertexId w, Timestep then, Timestep at) {
              const int sum =
                  c + query.others->collisions_of_step(query.agent, here, d.place(w), at);
              if (sum < below) push(open_[static_cast<std::size_t>(sum)], then, {w, index});
            });
      }
    }
  }
  return false;
}

}  // namespace quadrille::discrete
