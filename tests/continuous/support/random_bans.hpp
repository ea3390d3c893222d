// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "paths/bans.hpp"

namespace quadrille::continuous::test {

/// Bans by slot.
using Slots = std::vector<std::vector<Ban>>;

/// Up to `max_slots` slots of one to three bans each, at any edges and vertices, that begin by
/// `last` and are short, long or without end.
[[nodiscard]] inline Slots random_slots(Draw& draw, const Roadmap& roadmap, int max_slots,
                                        Ticks last) {
  Slots slots(static_cast<std::size_t>(draw.number(0, max_slots)));
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(n) - 1));
  };
  for (std::vector<Ban>& bans : slots)
    for (std::int64_t n = draw.number(1, 3); n > 0; --n) {
      const Ticks begin(draw.number(-5, last.value()));
      const Ticks length(draw.chance(60) ? draw.number(1, 9) : draw.number(10, 60));
      const TickInterval when{begin, draw.chance(4) ? kForever : begin + length};
      if (roadmap.num_edges() > 0 && draw.chance(50))
        bans.push_back(Ban::start(EdgeId(below(roadmap.num_edges())), when));
      else
        bans.push_back(Ban::stay(VertexId(below(roadmap.num_vertices())), when));
    }
  return slots;
}

/// Those of the slots for which `is_on` holds, in one list.
template <class Choice>
[[nodiscard]] std::vector<Ban> bans_of(const Slots& slots, const Choice& is_on) {
  std::vector<Ban> bans;
  for (std::size_t slot = 0; slot < slots.size(); ++slot)
    if (is_on(slot)) bans.insert(bans.end(), slots[slot].begin(), slots[slot].end());
  return bans;
}

/// An instance of one agent whose durations are small.
[[nodiscard]] inline Instance small_instance(std::uint32_t seed, std::size_t num_agents = 1) {
  RandomOptions options;
  options.num_vertices = 4 + seed % 3;
  options.num_agents = num_agents;
  options.size = 25;
  options.obstacles_percent = 0;  // there are bans enough
  options.no_waiting_percent = 40;
  return random_instance(seed, options);
}

}  // namespace quadrille::continuous::test
