// SPDX-License-Identifier: MIT
#include "execution/plans.hpp"

#include <memory>
#include <utility>

#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/discrete/primal.hpp"
#include "quadrille/discrete/solver.hpp"
#include "support/generators.hpp"

namespace quadrille::execution::test {

namespace {

continuous::test::RandomOptions shape_for(std::size_t agents) {
  continuous::test::RandomOptions shape;
  shape.num_agents = agents;
  shape.num_vertices = agents * 5;
  shape.size = geometry::Length(static_cast<std::int64_t>(15 + 20 * agents));
  shape.max_radius = 6;
  shape.obstacles_percent = 0;  // they wait for nobody
  shape.no_waiting_percent = 0;
  shape.edge_percent = agents > 4 ? 12 : 30;
  return shape;
}

std::optional<ContinuousCase> planned(std::uint32_t seed,
                                      const continuous::test::RandomOptions& shape) {
  const continuous::Instance instance = continuous::test::random_instance(seed, shape);
  continuous::SolveOptions options;
  options.gap_percent = 1e6;
  options.joint_work = 0;
  options.route_work = 0;
  options.limits.conflicts = 20;
  auto outcome = continuous::solve(instance, options);
  if (!outcome || !outcome->plan) return std::nullopt;
  return ContinuousCase{instance, std::move(*outcome->plan)};
}

}  // namespace

std::optional<ContinuousCase> continuous_case(std::uint32_t seed, std::size_t agents) {
  return planned(seed, shape_for(agents));
}

std::optional<ContinuousCase> passing_case(std::uint32_t seed, std::size_t agents) {
  continuous::test::RandomOptions shape = shape_for(agents);
  shape.no_waiting_percent = 100;
  return planned(seed, shape);
}

std::optional<DiscreteCase> leaving_case(std::uint64_t seed) {
  quadrille::support::Random random(seed);
  discrete::support::GridShape shape;
  shape.min_side = 2;
  shape.max_side = 6;
  shape.max_obstacles_percent = 20;
  shape.max_agents = 10;
  const discrete::Instance plain = discrete::support::random_grid(random, shape);
  std::vector<discrete::Agent> agents = plain.agents().items();
  for (discrete::Agent& agent : agents) {
    agent.leaves = random.percent(70);
    if (agent.leaves && random.percent(40)) agent.goals = agents[random.below(agents.size())].goals;
    if (random.percent(20)) agent.release = static_cast<Timestep>(random.below(4));
  }
  const auto instance = plain.with_agents(std::move(agents));
  if (!instance) return std::nullopt;
  discrete::SolveOptions options;
  options.limits.conflicts = 20;
  auto outcome = discrete::solve(*instance, options);
  if (!outcome || !outcome->plan) return std::nullopt;
  return DiscreteCase{*instance, std::move(*outcome->plan)};
}

std::optional<DiscreteCase> discrete_case(std::uint64_t seed) {
  quadrille::support::Random random(seed);
  discrete::support::GridShape shape;
  shape.min_side = 2;
  shape.max_side = 6;
  shape.max_obstacles_percent = 20;
  shape.max_agents = 10;
  const discrete::Instance instance = discrete::support::random_grid(random, shape);
  LimitMonitor limits{Limits{}};
  discrete::PrimalSearch search(instance, discrete::GoalDistances::make(instance, limits),
                                static_cast<std::uint32_t>(seed));
  if (search.advance(200'000, limits) != discrete::PrimalSearch::State::found) return std::nullopt;
  return DiscreteCase{instance, search.plan()};
}

}  // namespace quadrille::execution::test
