// SPDX-License-Identifier: MIT
#include "paths/path_finder.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

void PathFinder::start_search() {
  if (++stamp_ == 0) {
    layers_.clear();
    stamp_ = 1;
  }
  for (Buckets& buckets : open_)
    for (auto& bucket : buckets) bucket.clear();
}

void PathFinder::make_layers(Timestep slack) {
  const auto last = static_cast<std::size_t>(slack);
  while (layers_.size() <= last) {
    if (limits_ != nullptr) limits_->check_room_for(num_vertices_ * sizeof(Closed));
    layers_.emplace_back(num_vertices_);
  }
}

void PathFinder::push(Buckets& buckets, Timestep at, State state) {
  const auto index = static_cast<std::size_t>(at);
  if (buckets.size() <= index) buckets.resize(index + 1);
  buckets[index].push_back(state);
}

void PathFinder::trace(const Query& query, Timestep arrival, Path& path) {
  path.resize(static_cast<std::size_t>(arrival) + 1);
  VertexId v = query.distances.goal();
  for (Timestep t = arrival; t > 0; --t) {
    path[static_cast<std::size_t>(t)] = v;
    const auto slack = static_cast<std::size_t>(query.distances.slack(v, t));
    v = layers_[slack][v.index()].parent;
  }
  path[0] = v;
  QUADRILLE_REQUIRE(v == query.distances.start(), "a path begins at the start");
}

template <class Hit, class Push>
void PathFinder::expand(const Query& query, VertexId v, Timestep slack, const Hit& hit,
                        const Push& push) {
  ++effort_;
  if (limits_ != nullptr && effort_ % 64 == 0) limits_->check();
  const AgentDistances& d = query.distances;
  const Timestep max_slack = query.max_cost - d.free_cost();
  const Timestep h = d.to_goal(v), t = d.free_cost() + slack - h;
  const auto step = [&](VertexId w, Timestep slack_then) {
    if (slack_then > max_slack) return;
    if (layers_[static_cast<std::size_t>(slack_then)][w.index()].stamp == stamp_) return;
    bool blocked = false;
    const auto note = [&](std::uint32_t slot) {
      blocked = true;
      hit(slot, slack_then);
    };
    query.obstacles.for_each_at(w, t + 1, note);
    if (!blocked && w != v) query.obstacles.for_each_on(v, w, t, note);
    if (!blocked) push(w, slack_then, t + 1);
  };
  make_layers(std::min(slack + 2, max_slack));
  step(v, slack + 1);
  for (const VertexId w : d.graph().neighbours(v)) step(w, slack + 1 + d.to_goal(w) - h);
}

bool PathFinder::find_cheapest(const Query& query, Path& path) {
  const AgentDistances& d = query.distances;
  if (open_.size() < 3) open_.resize(3);
  start_search();
  first_hits_.assign(query.obstacles.num_slots(), kNoHit);
  const Timestep max_slack = query.max_cost - d.free_cost();
  if (max_slack < 0 || query.obstacles.earliest_rest() > query.max_cost) return false;
  make_layers(0);
  push(open_[0], 0, {d.start(), d.start()});
  for (Timestep slack = 0; slack <= max_slack; ++slack) {
    Buckets& buckets = open_[static_cast<std::size_t>(slack % 3)];
    for (std::size_t c = 0; c < buckets.size(); ++c) {
      while (!buckets[c].empty()) {
        const State state = buckets[c].back();
        buckets[c].pop_back();
        Closed& mark = layers_[static_cast<std::size_t>(slack)][state.vertex.index()];
        if (mark.stamp == stamp_) continue;
        mark = {stamp_, state.parent};
        if (state.vertex == d.goal()) {
          const Timestep arrival = d.free_cost() + slack;
          if (arrival >= query.obstacles.earliest_rest()) {
            trace(query, arrival, path);
            return true;
          }
        }
        expand(
            query, state.vertex, slack,
            [&](std::uint32_t slot, Timestep then) {
              first_hits_[slot] = std::min(first_hits_[slot], then);
            },
            [&](VertexId w, Timestep then, Timestep arrival) {
              const int more = query.others == nullptr ? 0
                                                       : query.others->collisions_of_step(
                                                             query.agent, state.vertex, w, arrival);
              push(open_[static_cast<std::size_t>(then % 3)], static_cast<Timestep>(c) + more,
                   {w, state.vertex});
            });
      }
    }
  }
  return false;
}

bool PathFinder::find_quietest(const Query& query, int below, Path& path) {
  QUADRILLE_REQUIRE(query.others != nullptr, "collisions with somebody");
  const std::int64_t last_effort =
      query.max_effort > INT64_MAX - effort_ ? INT64_MAX : effort_ + query.max_effort;
  const AgentDistances& d = query.distances;
  if (query.max_cost < d.free_cost() || query.obstacles.earliest_rest() > query.max_cost)
    return false;
  if (static_cast<int>(open_.size()) < below) open_.resize(static_cast<std::size_t>(below));
  start_search();
  if (below <= 0) return false;
  make_layers(0);
  push(open_[0], 0, {d.start(), d.start()});
  for (int c = 0; c < below; ++c) {
    Buckets& buckets = open_[static_cast<std::size_t>(c)];
    for (std::size_t s = 0; s < buckets.size(); ++s) {  // steps never lessen the slack
      while (!buckets[s].empty()) {
        if (effort_ >= last_effort) return false;
        const State state = buckets[s].back();
        buckets[s].pop_back();
        const auto slack = static_cast<Timestep>(s);
        Closed& mark = layers_[static_cast<std::size_t>(slack)][state.vertex.index()];
        if (mark.stamp == stamp_) continue;
        mark = {stamp_, state.parent};
        const Timestep arrival = d.free_cost() + slack;
        if (state.vertex == d.goal() && arrival >= query.obstacles.earliest_rest() &&
            c + query.others->collisions_of_rest(query.agent, arrival) < below) {
          trace(query, arrival, path);
          return true;
        }
        expand(
            query, state.vertex, slack, [](std::uint32_t, Timestep) {},
            [&](VertexId w, Timestep then, Timestep at) {
              const int sum =
                  c + query.others->collisions_of_step(query.agent, state.vertex, w, at);
              if (sum < below) push(open_[static_cast<std::size_t>(sum)], then, {w, state.vertex});
            });
      }
    }
  }
  return false;
}

}  // namespace quadrille::discrete
