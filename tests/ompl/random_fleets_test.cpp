// SPDX-License-Identifier: MIT
// Fleets of two classes on random roadmaps of OMPL, one for each class: what OMPL gets back is
// what the plan says, and OMPL finds it valid.
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/prm/PRM.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "quadrille/fleet/solver.hpp"
#include "quadrille/ompl/paths.hpp"
#include "quadrille/ompl/planner_data.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::ompl_bridge {
namespace {

namespace ob = ::ompl::base;
namespace og = ::ompl::geometric;
using namespace quadrille::fleet;
using namespace quadrille::units;
using quadrille::support::Random;
using quadrille::support::scaled;

constexpr double kSize = 10, kStep = 0.0005;  // Of checks of motions: a share of the diagonal.

struct Pillar {
  double x, y, radius;
};

/// Where a disc of the radius fits among the pillars.
ob::SpaceInformationPtr space_for(double radius, const std::vector<Pillar>& pillars) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(0, kSize);
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([radius, pillars](const ob::State* state) {
    const double* const at = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return std::all_of(pillars.begin(), pillars.end(), [&](const Pillar& p) {
      return std::hypot(at[0] - p.x, at[1] - p.y) >= p.radius + radius;
    });
  });
  info->setStateValidityCheckingResolution(kStep);
  info->setup();
  return info;
}

/// The vertices of a roadmap for robots of this radius, in a component of its own.
std::vector<VertexId> grow(RoadmapBuilder& roads, double radius,
                           const std::vector<Pillar>& pillars) {
  // As docs/robots.md says: half a step, and what rounding moves.
  const auto space = space_for(radius + kSize * std::sqrt(2) * kStep / 2 + 0.001, pillars);
  og::PRM prm(space);
  prm.setProblemDefinition(std::make_shared<ob::ProblemDefinition>(space));
  prm.setup();
  prm.growRoadmap(ob::PlannerTerminationCondition([&] { return prm.milestoneCount() >= 40; }));
  return add_roadmap(roads, prm).value();
}

struct Class {
  double radius;
  MetresPerSecond speed;
  std::vector<VertexId> vertices = {};
};

/// `count` vertices at least `apart` from each other, and from `taken`.
std::vector<VertexId> stations(Random& random, const RoadmapBuilder& roads, const Class& kind,
                               std::size_t count, std::vector<VertexId>& taken) {
  std::vector<VertexId> found;
  auto candidates = kind.vertices;
  random.shuffle(candidates);
  for (const VertexId v : candidates) {
    const bool is_near = std::any_of(taken.begin(), taken.end(), [&](VertexId w) {
      return distance(roads.position(v), roads.position(w)) < 1_m;
    });
    if (is_near || found.size() == count) continue;
    found.push_back(v);
    taken.push_back(v);
  }
  return found;
}

void expect_same(const TimedPath& path, const TimedGeometric& made, const RobotSpec& robot) {
  ASSERT_EQ(made.times.size(), made.path.getStateCount());
  EXPECT_EQ(made.times.front(), 0_s);
  EXPECT_EQ(made.times.back(), path.cost());
  Seconds waits(0), moving(0);
  for (std::size_t k = 0; k < made.times.size(); ++k) {
    const double* const at = made.path.getState(static_cast<unsigned>(k))
                                 ->as<ob::RealVectorStateSpace::StateType>()
                                 ->values;
    EXPECT_NEAR(at[0], path.at(made.times[k]).x.value(), 1e-9);
    EXPECT_NEAR(at[1], path.at(made.times[k]).y.value(), 1e-9);
    if (k == 0) continue;
    const Seconds step = made.times[k] - made.times[k - 1];
    EXPECT_GT(step, 0_s);
    const double* const before = made.path.getState(static_cast<unsigned>(k - 1))
                                     ->as<ob::RealVectorStateSpace::StateType>()
                                     ->values;
    const double way = std::hypot(at[0] - before[0], at[1] - before[1]);
    (way == 0 ? waits : moving) += step;
    // Each lane takes its length at the speed of the robot, to half a step of time.
    if (way > 0) {
      EXPECT_NEAR(step.value(), way / robot.speed.value(), 0.0051);
    }
    const Seconds middle = made.times[k - 1] + step / 2;
    EXPECT_NEAR(path.at(middle).x.value(), (at[0] + before[0]) / 2, 1e-9);
    EXPECT_NEAR(path.at(middle).y.value(), (at[1] + before[1]) / 2, 1e-9);
  }
  EXPECT_NEAR((waits + moving).value(), path.cost().value(), 1e-9);
  EXPECT_NEAR(made.path.length() / robot.speed.value(), moving.value(),
              0.0051 * static_cast<double>(made.times.size()));
}

TEST(OmplFleets, PlansOnRandomRoadmapsAreValidForOmpl) {
  std::size_t num_plans = 0, num_paths = 0;
  for (std::uint32_t seed = 1; seed <= scaled(40); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Pillar> pillars;
    for (int k = 0; k < 4; ++k)
      pillars.push_back({static_cast<double>(random.between(20, 80)) / 10,
                         static_cast<double>(random.between(20, 80)) / 10,
                         static_cast<double>(random.between(3, 10)) / 10});
    RoadmapBuilder roads;
    Class classes[] = {{0.45, 0.7_mps}, {0.2, 1.3_mps}};
    std::vector<VertexId> starts_taken, goals_taken;
    std::vector<std::pair<RobotSpec, std::pair<VertexId, VertexId>>> robots;
    for (Class& kind : classes) {
      kind.vertices = grow(roads, kind.radius, pillars);
      const auto starts = stations(random, roads, kind, 3, starts_taken);
      const auto goals = stations(random, roads, kind, 3, goals_taken);
      for (std::size_t k = 0; k < std::min(starts.size(), goals.size()); ++k)
        robots.push_back({{.name = {}, .body = Disc(Metres(kind.radius)), .speed = kind.speed},
                          {starts[k], goals[k]}});
    }
    Fleet fleet(roads.build().value());
    for (const auto& [spec, task] : robots) fleet.robot(spec).from(task.first).to(task.second);
    fleet::SolveOptions options;
    options.limits.conflicts = 200;
    options.gap_percent = 20;
    const auto outcome = solve(fleet, options);
    ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
    if (!outcome->plan) continue;  // A roadmap in two parts, or pillars that leave no room.
    ++num_plans;
    Seconds sum(0);
    for (const AgentId robot : fleet.robot_ids()) {
      const RobotSpec& spec = fleet.spec(robot);
      const Class& kind = classes[spec.speed == classes[0].speed ? 0 : 1];
      const TimedPath& path = (*outcome->plan)[robot];
      const auto made = to_geometric(path, space_for(kind.radius, pillars)).value();
      EXPECT_TRUE(made.path.check());
      expect_same(path, made, spec);
      sum += made.times.back();
      ++num_paths;
      // No robot leaves the roadmap of its class.
      for (const Stop& stop : path.stops())
        EXPECT_EQ(std::count(kind.vertices.begin(), kind.vertices.end(), stop.vertex), 1);
    }
    EXPECT_NEAR(sum.value(), outcome->cost.value().value(), 1e-9);
  }
  EXPECT_GE(num_plans, scaled(40) / 2);
  EXPECT_GE(num_paths, 2 * num_plans);
}

}  // namespace
}  // namespace quadrille::ompl_bridge
