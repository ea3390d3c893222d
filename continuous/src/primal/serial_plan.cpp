// SPDX-License-Identifier: MIT
#include "primal/serial_plan.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "primal/road_settling.hpp"
#include "primal/serial_moves.hpp"
#include "primal/serial_search.hpp"
#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous {
namespace {

/// For settling in either way: some seconds at worst.
constexpr std::int64_t kSettling = 100'000'000;
constexpr std::int64_t kCutting = 20'000'000;
/// Agents times places times agents: tables of 32 MiB.
constexpr std::size_t kMostFacts = std::size_t{1} << 28;

std::optional<Plan> parallel(StandingBodies& bodies, std::vector<SerialMove> moves) {
  moves = without_loops(bodies, std::move(moves), kCutting);
  if (!is_serial_plan(bodies, moves)) return std::nullopt;
  Plan plan = earliest_plan(bodies, moves);
  if (!verify(bodies.scene().instance(), plan).valid()) return std::nullopt;
  return plan;
}

}  // namespace

std::optional<Plan> settle_agents(Scene& scene) {
  try {
    StandingBodies bodies(scene);
    if (!Standing(bodies).are_apart()) return std::nullopt;
    for (const GivingWay giving_way : {GivingWay::vertices, GivingWay::lanes}) {
      std::int64_t effort = 0;
      auto moves = settle_on_roads(bodies, giving_way, kSettling, effort);
      if (!moves) continue;
      if (auto plan = parallel(bodies, *std::move(moves))) return plan;
    }
  } catch (const LimitReached&) {
  }
  return std::nullopt;
}

std::optional<Plan> search_serial_plan(Scene& scene, std::int64_t effort) {
  const std::size_t num_agents = scene.instance().num_agents();
  if (num_agents * (num_agents + 1) > kMostFacts / (scene.instance().roadmap().num_vertices() + 1))
    return std::nullopt;
  try {
    StandingBodies bodies(scene);
    if (!Standing(bodies).are_apart()) return std::nullopt;
    SerialSearch search(bodies);
    if (search.advance(effort) == SerialSearch::State::found)
      return parallel(bodies, search.moves());
  } catch (const LimitReached&) {
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
