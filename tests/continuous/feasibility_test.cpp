// SPDX-License-Identifier: MIT
#include "quadrille/continuous/feasibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "continuous/random_instance.hpp"
#include "quadrille/continuous/solver.hpp"

namespace quadrille::continuous {
namespace {

constexpr StuckPair kBoth{AgentId(0), AgentId(1)};

Instance discs(std::vector<Point> points,
               const std::vector<std::pair<std::size_t, std::size_t>>& roads,
               std::vector<Agent> agents) {
  std::vector<Edge> edges;
  for (const auto& [u, v] : roads) {
    edges.push_back({VertexId(u), VertexId(v), std::nullopt});
    edges.push_back({VertexId(v), VertexId(u), std::nullopt});
  }
  auto roadmap = Roadmap::make(std::move(points), std::move(edges)).value();
  return Instance::make(std::make_shared<const Roadmap>(std::move(roadmap)), std::move(agents))
      .value();
}

Agent agent(std::size_t start, std::size_t goal, Length radius) {
  return {VertexId(start), VertexId(goal), radius, kUnitSpeed};
}

TEST(StuckPair, SwappingOnALine) {
  for (const std::size_t length : {2U, 3U, 5U}) {
    std::vector<Point> points;
    std::vector<std::pair<std::size_t, std::size_t>> roads;
    for (std::size_t v = 0; v < length; ++v) {
      points.push_back({static_cast<Length>(v) * 1000, 0});
      if (v > 0) roads.emplace_back(v - 1, v);
    }
    const Instance line = discs(points, roads, {agent(0, length - 1, 1), agent(length - 1, 0, 1)});
    EXPECT_EQ(find_stuck_pair(line), kBoth);
    SolveOptions options;
    options.limits.wall_s = 0;  // decided before any search
    const SolveOutcome outcome = solve(line, options);
    EXPECT_EQ(outcome.status, Status::infeasible);
    EXPECT_EQ(outcome.explanation, describe(kBoth));
  }
}

TEST(StuckPair, ASidingHasToBeDeepEnough) {
  const auto with_radius = [](Length radius) {
    return discs({{0, 0}, {1000, 0}, {2000, 0}, {1000, 800}}, {{0, 1}, {1, 2}, {1, 3}},
                 {agent(0, 2, radius), agent(2, 0, 400)});
  };
  EXPECT_EQ(find_stuck_pair(with_radius(400)), std::nullopt);  // they touch
  EXPECT_EQ(find_stuck_pair(with_radius(401)), kBoth);
}

TEST(StuckPair, ParallelRoadsHaveToBeFarEnoughApart) {
  const auto with_radius = [](Length radius) {
    return discs({{0, 0}, {1000, 0}, {0, 300}, {1000, 300}}, {{0, 1}, {2, 3}},
                 {agent(0, 1, radius), agent(3, 2, 100)});
  };
  EXPECT_EQ(find_stuck_pair(with_radius(200)), std::nullopt);
  EXPECT_EQ(find_stuck_pair(with_radius(201)), kBoth);
}

TEST(StuckPair, WhoStandsWithoutAnyEdgeIsInTheWayOrNot) {
  const auto at = [](Length y) {
    return discs({{0, 0}, {1000, 0}, {500, y}}, {{0, 1}}, {agent(0, 1, 100), agent(2, 2, 100)});
  };
  EXPECT_EQ(find_stuck_pair(at(200)), std::nullopt);
  EXPECT_EQ(find_stuck_pair(at(199)), kBoth);
}

TEST(StuckPair, TheOthersAndTheEffortCount) {
  const Instance line = discs({{0, 0}, {1000, 0}, {0, 9000}}, {{0, 1}},
                              {agent(2, 2, 5), agent(0, 1, 1), agent(1, 0, 1)});
  EXPECT_EQ(find_stuck_pair(line), (StuckPair{AgentId(1), AgentId(2)}));
  EXPECT_EQ(find_stuck_pair(line, 3), std::nullopt);
  EXPECT_EQ(find_stuck_pair(discs({{0, 0}}, {}, {})), std::nullopt);
}

/// Joint positions by samples on the edges: flooding from the starts, as far as centres keep
/// `reach` apart.
class Flood {
 public:
  static constexpr int kSteps = 24;  // per edge

  Flood(const Instance& instance, double reach) : instance_(instance), reach_(reach) {
    const Roadmap& roadmap = instance.roadmap();
    for (std::size_t v = 0; v < roadmap.num_vertices(); ++v) add(roadmap.positions()[v]);
    for (const Edge& edge : roadmap.edges()) {
      std::size_t last = edge.from.index();
      const Point a = roadmap.position(edge.from), b = roadmap.position(edge.to);
      for (int k = 1; k < kSteps; ++k) {
        const double share = static_cast<double>(k) / kSteps;
        x_.push_back(static_cast<double>(a.x) + share * static_cast<double>(b.x - a.x));
        y_.push_back(static_cast<double>(a.y) + share * static_cast<double>(b.y - a.y));
        near_.emplace_back();
        link(last, x_.size() - 1);
        last = x_.size() - 1;
      }
      link(last, edge.to.index());
    }
  }

  [[nodiscard]] bool reaches_goals() const {
    const Agent &a = instance_.agent(AgentId(0)), &b = instance_.agent(AgentId(1));
    const std::size_t n = x_.size();
    std::vector<bool> seen(n * n, false);
    std::vector<std::pair<std::size_t, std::size_t>> stack{{a.start.index(), b.start.index()}};
    seen[a.start.index() * n + b.start.index()] = true;
    while (!stack.empty()) {
      const auto [p, q] = stack.back();
      stack.pop_back();
      const auto visit = [&](std::size_t r, std::size_t s) {
        if (seen[r * n + s] || std::hypot(x_[r] - x_[s], y_[r] - y_[s]) < reach_) return;
        seen[r * n + s] = true;
        stack.emplace_back(r, s);
      };
      for (const std::size_t r : near_[p]) visit(r, q);
      for (const std::size_t s : near_[q]) visit(p, s);
    }
    return seen[a.goal.index() * n + b.goal.index()];
  }

  /// The longest way between two neighbouring samples.
  [[nodiscard]] double longest_step() const {
    double longest = 0;
    for (std::size_t p = 0; p < x_.size(); ++p)
      for (const std::size_t q : near_[p])
        longest = std::max(longest, std::hypot(x_[p] - x_[q], y_[p] - y_[q]));
    return longest;
  }

 private:
  void add(const Point& point) {
    x_.push_back(static_cast<double>(point.x));
    y_.push_back(static_cast<double>(point.y));
    near_.emplace_back();
  }
  void link(std::size_t p, std::size_t q) {
    near_[p].push_back(q);
    near_[q].push_back(p);
  }

  const Instance& instance_;
  const double reach_;
  std::vector<double> x_, y_;
  std::vector<std::vector<std::size_t>> near_;
};

TEST(StuckPair, AgreesWithSamplesOfTheJointPositions) {
  test::RandomOptions options;
  options.num_vertices = 5;
  options.num_agents = 2;
  int stuck = 0, free = 0;
  for (std::uint32_t seed = 0; seed < 250; ++seed) {
    const Instance instance = test::random_instance(seed, options);
    SCOPED_TRACE(test::describe(instance));
    const auto reach =
        static_cast<double>(instance.agent(AgentId(0)).radius + instance.agent(AgentId(1)).radius);
    const double step = Flood(instance, reach).longest_step();
    const bool is_stuck = find_stuck_pair(instance).has_value();
    // With room to spare between samples nothing is jumped over; with less room nothing is missed.
    if (Flood(instance, reach + step / 2).reaches_goals()) {
      EXPECT_FALSE(is_stuck);
      ++free;
    }
    if (!Flood(instance, reach - step).reaches_goals()) {
      EXPECT_TRUE(is_stuck);
      ++stuck;
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(stuck, 20);
}

}  // namespace
}  // namespace quadrille::continuous
