// SPDX-License-Identifier: MIT
#include "rolling/window.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

Window::Window(std::size_t num_vertices, std::span<const VertexId> places, Timestep most)
    : num_vertices_(num_vertices),
      num_agents_(places.size()),
      num_slots_(static_cast<std::size_t>(most) + 1),
      places_(num_slots_ * num_agents_),
      occupants_(num_slots_ * num_vertices_, kNobody) {
  QUADRILLE_REQUIRE(most >= 1, "a window has a timestep");
  std::copy(places.begin(), places.end(), places_.begin());
  for (std::size_t i = 0; i < num_agents_; ++i)
    occupants_[places[i].index()] = static_cast<std::uint32_t>(i);
}

void Window::push(std::span<const VertexId> configuration) {
  QUADRILLE_REQUIRE(static_cast<std::size_t>(length_) + 1 < num_slots_, "there is room");
  ++length_;
  const std::size_t to = slot(length_);
  for (std::size_t i = 0; i < num_agents_; ++i) {
    places_[to * num_agents_ + i] = configuration[i];
    occupants_[to * num_vertices_ + configuration[i].index()] = static_cast<std::uint32_t>(i);
  }
}

void Window::pop() {
  QUADRILLE_REQUIRE(length_ >= 1, "there is a timestep to come");
  for (const VertexId v : configuration(0))
    occupants_[first_ * num_vertices_ + v.index()] = kNobody;
  first_ = slot(1);
  --length_;
}

void Window::take_out(AgentId agent) {
  for (Timestep t = 0; t <= length_; ++t)
    occupants_[slot(t) * num_vertices_ + at(agent, t).index()] = kNobody;
}

void Window::put(AgentId agent, const Path& path) {
  QUADRILLE_REQUIRE(path.size() == static_cast<std::size_t>(length_) + 1, "as long as the window");
  for (Timestep t = 0; t <= length_; ++t) {
    const VertexId v = path[static_cast<std::size_t>(t)];
    places_[slot(t) * num_agents_ + agent.index()] = v;
    occupants_[slot(t) * num_vertices_ + v.index()] = agent.value();
  }
}

Path Window::path(AgentId agent) const {
  Path path;
  for (Timestep t = 0; t <= length_; ++t) path.push_back(at(agent, t));
  return path;
}

}  // namespace quadrille::discrete
