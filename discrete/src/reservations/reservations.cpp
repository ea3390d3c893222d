// SPDX-License-Identifier: MIT
#include "reservations/reservations.hpp"

#include <algorithm>

namespace quadrille::discrete {

void Reservations::add(AgentId agent, const Path& path) {
  for_each_stay(agent, path, [&](VertexId v, const Stay& stay) {
    auto& stays = stays_[v];
    const std::size_t at = first_ending_from(v, stay.begin);
    stays.insert(stays.begin() + static_cast<std::ptrdiff_t>(at), stay);
  });
}

void Reservations::remove(const Path& path) {
  for_each_stay(AgentId(), path, [&](VertexId v, const Stay& stay) {
    auto& stays = stays_[v];
    const std::size_t at = first_ending_from(v, stay.begin);
    stays.erase(stays.begin() + static_cast<std::ptrdiff_t>(at));
  });
}

const Stay* Reservations::stay_at(VertexId v, Timestep t) const {
  const auto& stays = stays_[v];
  const std::size_t at = first_ending_from(v, t);
  return at < stays.size() && stays[at].begin <= t ? &stays[at] : nullptr;
}

}  // namespace quadrille::discrete
