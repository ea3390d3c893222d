// SPDX-License-Identifier: MIT
// Robots whose bodies are others at different vertices and on different edges, against the oracle.
#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "continuous/support/oracle_check.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/second_opinion.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/geometry/turning.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

RandomOptions with_shapes(std::uint32_t seed) {
  RandomOptions random;
  random.num_agents = 2 + seed % 2;
  random.num_vertices = 4 + seed / 2 % 4;
  random.edge_percent = 30 + static_cast<int>(seed / 8 % 3) * 15;
  random.polygon_percent = 60;
  random.space_percent = 0;
  random.shapes_percent = 100;
  random.under_way_percent = seed % 5 == 0 ? 100 : 0;
  random.goal_sets_percent = seed % 7 == 0 ? 50 : 0;
  return random;
}

class Shapes : public testing::TestWithParam<Asked> {};

TEST_P(Shapes, AgreeWithTheOracle) {
  const auto [objective, system] = GetParam();
  const auto count = static_cast<std::uint32_t>(support::scaled(250));
  const std::uint32_t part = 2 * static_cast<std::uint32_t>(objective == Objective::makespan) +
                             static_cast<std::uint32_t>(system == System::smt_cbs);
  const std::uint32_t first = 40'000'000 + part * 1'000'000;
  constexpr std::size_t max_moves = 4;
  Tally tally;
  int num_differ = 0;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const Instance instance = random_instance(seed, with_shapes(seed));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, objective, max_moves);
    for (const Plan& plan : oracle.some_plans) {
      ASSERT_TRUE(verify(instance, plan).valid());
      ASSERT_EQ(find_contradiction(true, ask_fcl(instance, plan)), "");
    }
    SolveOptions options;
    options.objective = objective;
    options.system = system;
    options.limits.conflicts = 3000;
    // Each of the searches for few agents alone, and none of them.
    options.joint_work = seed % 3 == 0 ? SolveOptions().joint_work : 0;
    options.route_work = seed % 3 == 1 ? SolveOptions().route_work : 0;
    options.limits.cpu_s = oracle.best ? 2 : 0.1;
    options.debug.audit = true;
    if (!oracle.some_plans.empty() && seed % 2 == 0)
      options.debug.known_plan = oracle.some_plans[seed % oracle.some_plans.size()];
    check_against(oracle, max_moves, instance, options, tally);
    if (HasFatalFailure()) return;
    num_differ += instance.has_shapes() ? 1 : 0;
  }
  record(tally);
  if (count < 150) return;  // scaled down, for slow builds: too few to count on chance
  EXPECT_GE(10 * num_differ, 8 * static_cast<int>(count));
  EXPECT_GE(5 * tally.solvable, 2 * static_cast<int>(count));
  EXPECT_GE(10 * tally.optimal, 8 * tally.solvable);
}

INSTANTIATE_TEST_SUITE_P(All, Shapes, all_asked(), name_of);

/// The best plan with each move put off or brought forward by little: what `verify` says of
/// collisions is what FCL says, which has its own idea of them.
TEST(ShapesOfPlans, AreSeenAlikeByFcl) {
  const auto count = static_cast<std::uint32_t>(support::scaled(300));
  int num_valid = 0, num_collisions = 0;
  for (std::uint32_t seed = 50'000'000; seed < 50'000'000 + count; ++seed) {
    const Instance instance = random_instance(seed, with_shapes(seed));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(instance));
    const OrderSearch oracle = search_orders(instance, Objective::sum_of_costs, 3);
    if (!oracle.best) continue;
    Draw draw(seed);
    for (int change = 0; change < 10; ++change) {
      Plan plan = oracle.best_plan;
      for (Path& path : plan.paths) {
        if (path.size() < 2 || instance.agent(AgentId(0)).under_way) continue;
        const Ticks by = draw.ticks(0, 12);
        path.front().depart += by;
        for (std::size_t k = 1; k < path.size(); ++k) {
          path[k].arrive += by;
          path[k].depart += by;
        }
      }
      const VerifyReport report = verify(instance, plan);
      ASSERT_EQ(find_contradiction(report.valid(), ask_fcl(instance, plan)), "");
      ++(report.valid() ? num_valid : num_collisions);
    }
  }
  if (count < 150) return;
  EXPECT_GE(num_valid, static_cast<int>(count));
  EXPECT_GE(num_collisions, static_cast<int>(count) / 2);
}

/// Where the agent leaves on arrival, an obstacle that appears meets the shape of the vertex, which
/// is smaller than the one of the move that ends.
TEST(ShapesOfPlans, MeetWhatAppearsWhereTheyLeave) {
  const auto ask = [](Length x) {
    const std::vector<Point> points{{0, 0}, {0, 0}};
    const std::vector<ShapeId> shapes{ShapeId(0), ShapeId(0)};
    Agent agent{VertexId(0), VertexId(1), Disc{40}};
    agent.shapes = {Disc{80}};
    agent.leaves = true;
    const MovingObstacle obstacle{Disc{10}, {{{x, 0}, 10, 20}}, true};
    const Instance instance =
        Instance::make(
            Roadmap::make(points,
                          {{VertexId(0), VertexId(1), Ticks(10), Groups::all(), ShapeId(1)}}, {},
                          shapes)
                .value(),
            {agent}, kDefaultResolution, {}, {obstacle})
            .value();
    const Plan plan{{{{VertexId(0), 0, 0}, {VertexId(1), 10, 10}}}};
    const bool is_valid = verify(instance, plan).valid();
    EXPECT_EQ(find_contradiction(is_valid, ask_fcl(instance, plan)), "");
    return is_valid;
  };
  EXPECT_FALSE(ask(30));
  EXPECT_TRUE(ask(60));
}

TEST(ShapesInFiles, AreReadAsTheyWereWritten) {
  for (std::uint32_t seed = 0; seed < support::scaled(200); ++seed) {
    const Instance instance = random_instance(seed, with_shapes(seed));
    std::ostringstream out;
    ASSERT_FALSE(write_instance_json(out, "", instance));
    std::istringstream in(out.str());
    const auto again = read_instance_json(in, "again.json");
    ASSERT_TRUE(again) << again.error().to_string();
    EXPECT_EQ(again->agents().items(), instance.agents().items());
    EXPECT_EQ(again->roadmap().edges(), instance.roadmap().edges());
    EXPECT_EQ(again->roadmap().shapes(), instance.roadmap().shapes());
  }
}

Body box(Length half_width, Length half_height) {
  return ConvexPolygon::make({{-half_width, -half_height},
                              {half_width, -half_height},
                              {half_width, half_height},
                              {-half_width, half_height}})
      .value();
}

/// Two places, 200 apart; at each a robot of 160 x 80 that faces along x and has to turn to y, each
/// with a vertex for both headings, and an edge for the turn.
struct Turning {
  std::vector<Point> points{{0, 0}, {0, 0}, {0, 0}, {0, 0}};
  std::vector<ShapeId> shapes{ShapeId(0), ShapeId(1), ShapeId(0), ShapeId(1)};
  std::vector<Edge> edges{{VertexId(0), VertexId(1), Ticks(10), Groups::all(), ShapeId(2)},
                          {VertexId(2), VertexId(3), Ticks(10), Groups::all(), ShapeId(2)}};
  std::vector<Body> bodies;

  explicit Turning(Length apart) {
    points[2].x = points[3].x = apart;
    const Body body = box(80, 40);
    bodies = {body, geometry::turned(body, {0, 1}).value(),
              geometry::swept_by_turn(body, {1, 0}, {0, 1}).value()};
  }
  [[nodiscard]] Result<Instance> instance() const {
    auto roadmap = Roadmap::make(points, edges, {}, shapes);
    if (!roadmap) return roadmap.error();
    Agent a{VertexId(0), VertexId(1), bodies[0]}, b{VertexId(2), VertexId(3), bodies[0]};
    a.shapes = b.shapes = {bodies.begin() + 1, bodies.end()};
    return Instance::make(std::move(roadmap).value(), {a, b});
  }
};

// Side by side they fill 160; a robot that turns reaches 89.4 to each side. At 178 both turn at
// once, up to rounding; below 169.4 not even one beside the other at rest.
TEST(Turning, TakesRoomWhileItLasts) {
  const auto answer = [](Length apart) {
    return solve(Turning(apart).instance().value(), {}).value();
  };
  EXPECT_EQ(answer(185).cost, 20);
  EXPECT_EQ(answer(175).cost, 30);  // one after the other
  const SolveOutcome one = answer(175);
  EXPECT_TRUE(verify(Turning(175).instance().value(), *one.plan).valid());
  EXPECT_EQ(answer(165).status, Status::infeasible);
  EXPECT_EQ(Turning(159).instance().error().code, ErrorCode::no_plan);  // the starts overlap
}

TEST(Turning, ShapesThatDoNotFitAreRefused) {
  Turning smaller(300);
  // A box around the turn that lacks a side of the robot by one unit.
  smaller.bodies[2] = ConvexPolygon::make({{-79, -90}, {90, -90}, {90, 90}, {-79, 90}}).value();
  const auto refused = smaller.instance();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_instance);
  EXPECT_NE(refused.error().message.find("shape 0 at vertex 0 is not inside of its shape 2"),
            std::string::npos)
      << refused.error().message;
  smaller.bodies[2] = ConvexPolygon::make({{-80, -90}, {90, -90}, {90, 90}, {-80, 90}}).value();
  EXPECT_TRUE(smaller.instance());

  Turning few(300);
  few.bodies.pop_back();
  EXPECT_EQ(few.instance().error().code, ErrorCode::invalid_instance);
  Turning parallel(300);
  parallel.edges.push_back(parallel.edges.front());
  parallel.edges.back().shape = ShapeId(1);
  EXPECT_EQ(parallel.instance().error().code, ErrorCode::invalid_instance);
  Turning wrong_number(300);
  wrong_number.shapes.pop_back();
  EXPECT_EQ(wrong_number.instance().error().code, ErrorCode::invalid_instance);
  Turning too_many(300);
  too_many.edges.front().shape = ShapeId(kMaxShapes + 1);
  EXPECT_EQ(too_many.instance().error().code, ErrorCode::out_of_range);
}

}  // namespace
}  // namespace quadrille::continuous::test
