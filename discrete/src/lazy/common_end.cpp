// SPDX-License-Identifier: MIT
#include "lazy/common_end.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::discrete {
namespace {

std::vector<CommonEnd::End> find_ends(const AgentDistances& distances) {
  std::vector<CommonEnd::End> ends;
  for (const VertexId goal : distances.goals().vertices())
    distances.for_each_end(goal, [&](VertexId state) {
      if (distances.from_start(state) == kUnreachable) return;
      ends.push_back({state, goal, VertexId(distances.states().num_vertices() + ends.size())});
    });
  return ends;
}

/// Behind the rests; `home` is the state of the chain where nothing is left to go.
Graph make_graph(const AgentDistances& distances, const std::vector<CommonEnd::End>& ends,
                 VertexId home) {
  const auto left = [&](Timestep steps) {
    return VertexId(home.index() + static_cast<std::size_t>(steps));
  };
  std::vector<Graph::Edge> arcs;
  for (const VertexId from : IdRange<VertexId>(distances.states().num_vertices()))
    for (const VertexId to : distances.states().neighbours(from)) arcs.emplace_back(from, to);
  Timestep longest = 0;
  for (const CommonEnd::End& end : ends) {
    const Timestep price = distances.price(end.goal);
    longest = std::max(longest, price);
    arcs.emplace_back(end.state, end.rest);
    arcs.emplace_back(end.rest, left(price));
  }
  for (Timestep steps = 1; steps <= longest; ++steps)
    arcs.emplace_back(left(steps), left(steps - 1));
  return Graph::make_directed(left(longest).index() + 1, arcs).value();
}

}  // namespace

CommonEnd::CommonEnd(const AgentDistances& distances)
    : ends_(find_ends(distances)),
      home_(distances.states().num_vertices() + ends_.size()),
      graph_(make_graph(distances, ends_, home_)) {}

VertexId CommonEnd::state_at(const End& end, Timestep arrival, Timestep price, Timestep t) const {
  if (t == arrival + 1) return end.rest;
  const Timestep left = std::max(0, arrival + kWayHome + price - t);
  return VertexId(home_.index() + static_cast<std::size_t>(left));
}

}  // namespace quadrille::discrete
