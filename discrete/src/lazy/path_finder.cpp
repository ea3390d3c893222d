// SPDX-License-Identifier: MIT
#include "path_finder.hpp"

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

PathFinder::Closed& PathFinder::closed(VertexId v, Timestep slack) {
  const auto layer = static_cast<std::size_t>(slack);
  if (layers_.size() <= layer) layers_.resize(layer + 1);
  if (layers_[layer].empty()) layers_[layer].resize(num_vertices_);
  return layers_[layer][v.index()];
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
    v = closed(v, query.distances.slack(v, t)).parent;
  }
  path[0] = v;
  QUADRILLE_REQUIRE(v == query.distances.start(), "a path begins at the start");
}

void PathFinder::expand_cheapest(const Query& query, VertexId v, Timestep slack,
                                 Timestep collisions) {
  const AgentDistances& d = query.distances;
  const Timestep max_slack = query.max_cost - d.free_cost();
  const Timestep t = d.free_cost() + slack - d.to_goal(v);
  const auto step = [&](VertexId w) {
    const Timestep slack_then = d.slack(w, t + 1);
    if (slack_then > max_slack || closed(w, slack_then).stamp == stamp_) return;
    bool blocked = false;
    const auto hit = [&](std::uint32_t slot) {
      blocked = true;
      first_hits_[slot] = std::min(first_hits_[slot], slack_then);
    };
    query.obstacles.for_each_at(w, t + 1, hit);
    if (!blocked && w != v) query.obstacles.for_each_on(v, w, t, hit);
    if (blocked) return;
    const int more =
        query.others == nullptr ? 0 : query.others->collisions_of_step(query.agent, v, w, t + 1);
    push(open_[static_cast<std::size_t>(slack_then % 3)], collisions + more, {w, v});
  };
  step(v);
  for (const VertexId w : d.graph().neighbours(v)) step(w);
}

bool PathFinder::find_cheapest(const Query& query, Path& path) {
  const AgentDistances& d = query.distances;
  if (open_.size() < 3) open_.resize(3);
  start_search();
  first_hits_.assign(query.obstacles.num_slots(), kNoHit);
  const Timestep max_slack = query.max_cost - d.free_cost();
  if (max_slack < 0 || query.obstacles.earliest_rest() > query.max_cost) return false;
  push(open_[0], 0, {d.start(), d.start()});
  for (Timestep slack = 0; slack <= max_slack; ++slack) {
    Buckets& buckets = open_[static_cast<std::size_t>(slack % 3)];
    for (std::size_t c = 0; c < buckets.size(); ++c) {
      while (!buckets[c].empty()) {
        const State state = buckets[c].back();
        buckets[c].pop_back();
        Closed& mark = closed(state.vertex, slack);
        if (mark.stamp == stamp_) continue;
        mark = {stamp_, state.parent};
        if (state.vertex == d.goal()) {
          const Timestep arrival = d.free_cost() + slack;
          if (arrival >= query.obstacles.earliest_rest()) {
            trace(query, arrival, path);
            return true;
          }
        }
        expand_cheapest(query, state.vertex, slack, static_cast<Timestep>(c));
      }
    }
  }
  return false;
}

void PathFinder::expand_quietest(const Query& query, VertexId v, Timestep slack, int collisions,
                                 int below) {
  const AgentDistances& d = query.distances;
  const Timestep max_slack = query.max_cost - d.free_cost();
  const Timestep t = d.free_cost() + slack - d.to_goal(v);
  const auto step = [&](VertexId w) {
    const Timestep slack_then = d.slack(w, t + 1);
    if (slack_then > max_slack || closed(w, slack_then).stamp == stamp_) return;
    bool blocked = false;
    const auto hit = [&](std::uint32_t) { blocked = true; };
    query.obstacles.for_each_at(w, t + 1, hit);
    if (!blocked && w != v) query.obstacles.for_each_on(v, w, t, hit);
    if (blocked) return;
    const int then = collisions + query.others->collisions_of_step(query.agent, v, w, t + 1);
    if (then < below) push(open_[static_cast<std::size_t>(then)], slack_then, {w, v});
  };
  step(v);
  for (const VertexId w : d.graph().neighbours(v)) step(w);
}

bool PathFinder::find_quietest(const Query& query, int below, Path& path) {
  QUADRILLE_REQUIRE(query.others != nullptr, "collisions with somebody");
  const AgentDistances& d = query.distances;
  if (query.max_cost < d.free_cost() || query.obstacles.earliest_rest() > query.max_cost)
    return false;
  if (static_cast<int>(open_.size()) < below) open_.resize(static_cast<std::size_t>(below));
  start_search();
  if (below <= 0) return false;
  push(open_[0], 0, {d.start(), d.start()});
  for (int c = 0; c < below; ++c) {
    Buckets& buckets = open_[static_cast<std::size_t>(c)];
    for (std::size_t s = 0; s < buckets.size(); ++s) {  // steps never lessen the slack
      while (!buckets[s].empty()) {
        const State state = buckets[s].back();
        buckets[s].pop_back();
        const auto slack = static_cast<Timestep>(s);
        Closed& mark = closed(state.vertex, slack);
        if (mark.stamp == stamp_) continue;
        mark = {stamp_, state.parent};
        const Timestep arrival = d.free_cost() + slack;
        if (state.vertex == d.goal() && arrival >= query.obstacles.earliest_rest() &&
            c + query.others->collisions_of_rest(query.agent, arrival) < below) {
          trace(query, arrival, path);
          return true;
        }
        expand_quietest(query, state.vertex, slack, c, below);
      }
    }
  }
  return false;
}

}  // namespace quadrille::discrete
