// SPDX-License-Identifier: MIT
// OMPL finds a roadmap, Quadrille a plan, OMPL gets timed paths back, late robots keep to the plan.
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <quadrille/execution/clearance.hpp>
#include <quadrille/execution/simulation.hpp>
#include <quadrille/fleet/solver.hpp>
#include <quadrille/ompl/paths.hpp>
#include <quadrille/ompl/planner_data.hpp>

namespace ob = ompl::base;
namespace og = ompl::geometric;
namespace qe = quadrille::execution;
using namespace quadrille::fleet;
using namespace quadrille::ompl_bridge;
using namespace quadrille::units;

namespace {

constexpr double kWidth = 20, kHeight = 12, kWidest = 0.35;
constexpr std::size_t kRobots = 12;

/// How far a place is from the walls and the nearest of eight blocks, or less; negative inside.
double clearance(double x, double y) {
  double free = std::min({x, y, kWidth - x, kHeight - y});
  for (int block = 0; block < 8; ++block)
    free = std::min(free, std::max(std::abs(x - 3.7 - 4.2 * (block % 4)) - 1.2,
                                   std::abs(y - 3.7 - 4.2 * (block / 4)) - 1.1));
  return free;
}

/// Where a robot of this radius fits.
ob::SpaceInformationPtr make_space(double radius) {
  auto space = std::make_shared<ob::RealVectorStateSpace>();
  space->addDimension(0, kWidth);
  space->addDimension(0, kHeight);
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([radius](const ob::State* state) {
    const double* const values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return clearance(values[0], values[1]) >= radius;
  });
  info->setStateValidityCheckingResolution(0.0005);
  info->setup();
  return info;
}

RoadmapBuilder make_roadmap(const ob::SpaceInformationPtr& space) {
  og::PRM prm(space);
  prm.setProblemDefinition(std::make_shared<ob::ProblemDefinition>(space));
  prm.setup();
  prm.growRoadmap(ob::PlannerTerminationCondition([&] { return prm.milestoneCount() >= 150; }));
  RoadmapBuilder roads({.length = 1_mm, .time = 50_ms});
  return add_roadmap(roads, prm) ? roads : RoadmapBuilder();
}

}  // namespace

int main() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  ompl::RNG::setSeed(1);
  ompl::RNG random;
  // With room for what OMPL may miss between two checks of a motion, and for rounding.
  const ob::SpaceInformationPtr space = make_space(kWidest + 0.01);
  RoadmapBuilder roads = make_roadmap(space);

  // Stations, far enough apart for any two robots, joined with the roadmap where the way is free.
  std::vector<Point> stations;
  std::vector<quadrille::VertexId> vertices;
  while (stations.size() < 2 * kRobots) {
    const double x = random.uniformReal(0, kWidth), y = random.uniformReal(0, kHeight);
    const Point place{Metres(x), Metres(y)};
    const auto is_near = [&](const Point& other) { return distance(place, other) < 0.8_m; };
    if (clearance(x, y) < kWidest + 0.02 || std::any_of(stations.begin(), stations.end(), is_near))
      continue;
    stations.push_back(place);
    vertices.push_back(roads.vertex(place));
    if (join(roads, *space, vertices.back()).value() == 0) return 1;
  }
  Fleet fleet(roads.build().value());
  const Metres radii[] = {0.2_m, 0.28_m, Metres(kWidest)};
  const MetresPerSecond speeds[] = {0.5_mps, 0.8_mps, 1.2_mps};
  for (std::size_t i = 0; i < kRobots; ++i)
    fleet.robot({.name = {}, .body = Disc(radii[i % 3]), .speed = speeds[i / 3 % 3]})
        .from(vertices[2 * i])
        .to(vertices[2 * i + 1]);

  SolveOptions options;
  options.limits.wall = 60_s;
  options.gap_percent = 5;
  const auto outcome = solve(fleet, options).value();
  const TimedPlan& plan = outcome.plan.value();
  std::size_t valid = 0;
  for (const quadrille::AgentId robot : fleet.robot_ids()) {
    const TimedGeometric made = to_geometric(plan[robot], make_space(kWidest)).value();
    valid += made.path.check() && made.times.back() == plan[robot].cost() ? 1 : 0;
  }
  std::cout << valid << " of " << kRobots << " paths are valid for OMPL\n"
            << "within 5 % of the best plan: "
            << (outcome.cost.value() <= 1.05 * outcome.lower_bound ? "yes" : "no") << "\n";

  // Robots that pause for up to 3 s, are up to 15 % slow, and are told every 50 ms how far to go.
  const auto order = qe::precedences(plan.instance(), plan.in_units()).value();
  for (const qe::Rule rule : {qe::Rule::naive, qe::Rule::gated, qe::Rule::coupled}) {
    std::size_t arrived = 0, collided = 0;
    for (std::uint64_t run = 0; run < 10; ++run) {
      qe::ClearanceWatch watch(plan.instance(), plan.in_units());
      const auto look = [&](auto before, auto after) { watch.add(before, after); };
      const auto delays = qe::draw_delays(order, {.longest_pause = 60}, run);
      arrived += qe::simulate(order, delays, rule, 1, look).all_arrived ? 1 : 0;
      collided += watch.contacts().empty() ? 0 : 1;
    }
    std::cout << qe::to_string(rule) << ": " << arrived << " of 10 runs end, robots collide in "
              << (collided > 0 ? "some" : "none") << "\n";
  }
}
