// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <limits>
#include <memory>

#include "quadrille/fleet/solver.hpp"
#include "quadrille/ompl/paths.hpp"
#include "quadrille/ompl/planner_data.hpp"

namespace quadrille::ompl_bridge {
namespace {

namespace ob = ::ompl::base;
using namespace quadrille::fleet;
using namespace quadrille::units;

// For all tests of this program: OMPL takes one seed, before anything is drawn.
[[maybe_unused]] const bool is_seeded = [] {
  ::ompl::msg::setLogLevel(::ompl::msg::LOG_ERROR);
  ::ompl::RNG::setSeed(3);
  return true;
}();

std::shared_ptr<ob::RealVectorStateSpace> plane() {
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(0, 10);
  return space;
}

/// All is free but what is less than a metre from (5, 5).
ob::SpaceInformationPtr around_a_pillar(const ob::StateSpacePtr& space, bool is_se2) {
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([is_se2](const ob::State* state) {
    const double x = is_se2 ? state->as<ob::SE2StateSpace::StateType>()->getX()
                            : state->as<ob::RealVectorStateSpace::StateType>()->values[0];
    const double y = is_se2 ? state->as<ob::SE2StateSpace::StateType>()->getY()
                            : state->as<ob::RealVectorStateSpace::StateType>()->values[1];
    return std::hypot(x - 5, y - 5) >= 1;
  });
  info->setStateValidityCheckingResolution(0.001);
  info->setup();
  return info;
}

/// States of the plane, and edges between them by index.
std::unique_ptr<ob::PlannerData> data_of(const ob::SpaceInformationPtr& info,
                                         const std::vector<std::pair<double, double>>& places,
                                         const std::vector<std::pair<unsigned, unsigned>>& edges) {
  auto data = std::make_unique<ob::PlannerData>(info);
  std::vector<ob::ScopedState<>> states;
  states.reserve(places.size());  // The data points to them.
  for (const auto& place : places) {
    states.emplace_back(info);
    states.back()[0] = place.first;
    states.back()[1] = place.second;
    data->addVertex(ob::PlannerDataVertex(states.back().get()));
  }
  for (const auto& edge : edges) data->addEdge(edge.first, edge.second);
  data->decoupleFromPlanner();
  return data;
}

TEST(OmplBridge, PlannerDataBecomesVerticesAndLanes) {
  const auto info = around_a_pillar(plane(), false);
  RoadmapBuilder roads;
  roads.vertex(9_m, 9_m, "mine");
  const auto vertices = add_planner_data(
      roads,
      *data_of(info, {{1, 1}, {2.5, 1}, {1.0001, 1}, {2, 2}}, {{0, 1}, {1, 0}, {0, 2}, {2, 3}}));
  ASSERT_TRUE(vertices.has_value());
  // The third state is the first one at a resolution of a millimetre.
  EXPECT_EQ(*vertices, (std::vector<VertexId>{VertexId(1), VertexId(2), VertexId(1), VertexId(3)}));
  const Roadmap made = roads.build().value();
  EXPECT_EQ(made.num_vertices(), 4u);
  EXPECT_EQ(made.num_lanes(), 3u);
  EXPECT_EQ(made.position(VertexId(2)), (Point{2.5_m, 1_m}));
  const auto& lanes = made.in_units()->edges();
  EXPECT_EQ(std::pair(lanes[0].from, lanes[0].to), std::pair(VertexId(1), VertexId(2)));
  EXPECT_EQ(std::pair(lanes[2].from, lanes[2].to), std::pair(VertexId(1), VertexId(3)));
}

TEST(OmplBridge, ARoadmapOfPrmIsTheSameGraph) {
  for (const bool is_se2 : {false, true}) {
    ob::StateSpacePtr space = plane();
    if (is_se2) {
      auto se2 = std::make_shared<ob::SE2StateSpace>();
      ob::RealVectorBounds bounds(2);
      bounds.setLow(0);
      bounds.setHigh(10);
      se2->setBounds(bounds);
      space = se2;
    }
    const auto info = around_a_pillar(space, is_se2);
    ::ompl::geometric::PRM prm(info);
    prm.setProblemDefinition(std::make_shared<ob::ProblemDefinition>(info));
    prm.setup();
    prm.growRoadmap(ob::PlannerTerminationCondition([&] { return prm.milestoneCount() >= 60; }));
    ob::PlannerData data(info);
    prm.getPlannerData(data);
    ASSERT_GE(data.numVertices(), 60u);
    RoadmapBuilder roads;
    const auto vertices = add_roadmap(roads, prm).value();
    const Roadmap made = roads.build().value();
    EXPECT_EQ(made.num_vertices(), data.numVertices());
    EXPECT_EQ(made.num_lanes(), data.numEdges());
    for (const auto& lane : made.in_units()->edges()) {
      // No lane leads through the pillar, whatever the rounding.
      const Point p = made.position(lane.from), q = made.position(lane.to);
      for (int k = 0; k <= 100; ++k)
        EXPECT_GE(std::hypot((p.x + k / 100.0 * (q.x - p.x)).value() - 5,
                             (p.y + k / 100.0 * (q.y - p.y)).value() - 5),
                  0.99);
    }
  }
}

TEST(OmplBridge, StationsAreJoinedWhereTheWayIsValid) {
  const auto info = around_a_pillar(plane(), false);
  RoadmapBuilder roads;
  const VertexId left = roads.vertex(3_m, 5_m), right = roads.vertex(7_m, 5_m);
  const VertexId above = roads.vertex(5_m, 8_m), inside = roads.vertex(5_m, 5_m);
  EXPECT_EQ(join(roads, *info, left).value(), 1u);  // Not through the pillar, and not into it.
  EXPECT_EQ(join(roads, *info, above).value(), 2u);
  EXPECT_EQ(join(roads, *info, above, {.neighbours = 1}).value(), 1u);
  EXPECT_EQ(join(roads, *info, inside).value(), 0u);
  EXPECT_EQ(join(roads, *info, right, {.among = std::vector{left, inside}}).value(), 0u);
  EXPECT_EQ(join(roads, *info, right, {.among = std::vector{above, above, right}}).value(), 1u);
  const Roadmap made = roads.build().value();
  EXPECT_EQ(made.num_lanes(), 4u);
  EXPECT_EQ(made.in_units()->out_edges(left).size(), 1u);
  EXPECT_EQ(made.in_units()->out_edges(right).size(), 1u);
  EXPECT_EQ(made.in_units()->out_edges(above).size(), 2u);
}

TEST(OmplBridge, PlansBecomePathsWithTimes) {
  const auto info = around_a_pillar(plane(), false);
  RoadmapBuilder roads({.length = 1_mm, .time = 50_ms});
  const VertexId a = roads.vertex(3_m, 5_m), b = roads.vertex(5_m, 8_m), c = roads.vertex(7_m, 5_m);
  roads.road(a, b).road(b, c);
  Fleet fleet(roads.build().value());
  const AgentId robot =
      fleet.robot({.name = "r", .body = Disc(0.2_m), .speed = 1_mps}).from(a).to(c);
  const continuous::Ticks lane =
      fleet.instance().value().duration(continuous::ClassId(0), continuous::EdgeId(0));
  const continuous::Ticks leave = lane + 10;
  const TimedPlan plan =
      TimedPlan::make(
          fleet, {{continuous::Path{{a, 0, 0}, {b, lane, leave}, {c, leave + lane, leave + lane}}}})
          .value();
  TimedGeometric made = to_geometric(plan[robot], info).value();
  ASSERT_EQ(made.path.getStateCount(), 4u);
  ASSERT_EQ(made.times.size(), 4u);
  EXPECT_TRUE(made.path.check());
  EXPECT_NEAR((made.times[2] - made.times[1]).value(), 0.5, 1e-12);
  EXPECT_EQ(made.times[3], plan[robot].cost());
  for (std::size_t k = 0; k < 4; ++k) {
    const auto* state =
        made.path.getState(static_cast<unsigned>(k))->as<ob::RealVectorStateSpace::StateType>();
    EXPECT_EQ(state->values[0], plan[robot].at(made.times[k]).x.value());
    EXPECT_EQ(state->values[1], plan[robot].at(made.times[k]).y.value());
  }
  // The same in SE2, with the yaw that is asked for.
  auto se2 = std::make_shared<ob::SE2StateSpace>();
  se2->setBounds(ob::RealVectorBounds(2));
  made = to_geometric(plan[robot], std::make_shared<ob::SpaceInformation>(se2), 0.5).value();
  EXPECT_EQ(made.path.getState(1)->as<ob::SE2StateSpace::StateType>()->getX(), 5);
  EXPECT_EQ(made.path.getState(1)->as<ob::SE2StateSpace::StateType>()->getYaw(), 0.5);
}

TEST(OmplBridge, HeightsOfR3) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  space->setBounds(0, 10);
  const auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([](const ob::State*) { return true; });
  info->setup();
  ob::PlannerData data(info);
  std::vector<ob::ScopedState<ob::RealVectorStateSpace>> states;
  const std::vector<std::array<double, 3>> places{
      {1, 1, 1}, {1, 1, 4.0004}, {1, 1, 4.0001}, {3, 1, 4}};
  for (const auto& [x, y, z] : places) {
    states.emplace_back(space);
    states.back()->values[0] = x;
    states.back()->values[1] = y;
    states.back()->values[2] = z;
  }
  for (const auto& state : states) data.addVertex(ob::PlannerDataVertex(state.get()));
  for (const unsigned to : {1u, 2u}) {
    data.addEdge(0, to);
    data.addEdge(to, 0);
    data.addEdge(to, 3);
  }
  RoadmapBuilder roads({.length = 1_mm, .time = 10_ms});
  const auto vertices = add_planner_data(roads, data).value();
  // What is in one place once it is rounded is one vertex, and what is above it is another one.
  EXPECT_EQ(roads.num_vertices(), 3u);
  EXPECT_EQ(vertices[1], vertices[2]);
  const Roadmap made = roads.build().value();
  EXPECT_EQ(made.position(vertices[1]), (Point{1_m, 1_m, 4_m}));
  EXPECT_EQ(made.num_lanes(), 3u);

  Fleet fleet(made);
  fleet.robot({.name = {}, .body = Disc(0.4_m), .speed = 1_mps}).from(vertices[0]).to(vertices[3]);
  const TimedPlan plan = *solve(fleet, {}).value().plan;
  const TimedPath& path = plan[AgentId(0)];
  EXPECT_EQ(path.cost(), 5_s);
  EXPECT_EQ(path.at(1_s), (Point{1_m, 1_m, 2_m}));
  auto geometric = to_geometric(path, info).value();
  EXPECT_NEAR(geometric.path.length(), 5, 1e-9);
  const auto* last = geometric.path.getStates().back()->as<ob::RealVectorStateSpace::StateType>();
  EXPECT_EQ(last->values[2], 4);
  // A space of the plane has no room for it.
  const auto flat = std::make_shared<ob::SpaceInformation>(plane());
  EXPECT_EQ(to_geometric(path, flat).error().code, ErrorCode::invalid_instance);
  const auto joined = roads.vertex(5_m, 1_m, 4_m);
  EXPECT_FALSE(join(roads, *flat, joined).has_value());
  EXPECT_EQ(join(roads, *info, joined).value(), 3u);
}

TEST(OmplBridge, RefusesOtherSpaces) {
  RoadmapBuilder roads;
  const auto four = std::make_shared<ob::RealVectorStateSpace>(4);
  const auto dubins = std::make_shared<ob::DubinsStateSpace>();
  for (const ob::StateSpacePtr& space : {ob::StateSpacePtr(four), ob::StateSpacePtr(dubins)}) {
    const auto info = std::make_shared<ob::SpaceInformation>(space);
    const auto refused = add_planner_data(roads, ob::PlannerData(info));
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_instance);
    EXPECT_NE(refused.error().message.find("is not supported: "), std::string::npos);
  }
  four->setName("drones");
  const auto info = std::make_shared<ob::SpaceInformation>(four);
  EXPECT_EQ(add_planner_data(roads, ob::PlannerData(info)).error().message,
            "the state space 'drones' is not supported: it has 4 dimensions, and roadmaps have 2 "
            "or 3");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto flat = std::make_shared<ob::SpaceInformation>(plane());
  EXPECT_FALSE(add_planner_data(roads, *data_of(flat, {{1, 1}, {nan, 1}}, {})).has_value());
  EXPECT_EQ(roads.num_vertices(), 0u);
}

}  // namespace
}  // namespace quadrille::ompl_bridge
