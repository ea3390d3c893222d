// SPDX-License-Identifier: MIT
//
// What `verify` has to say about plans that are changed in ways whose effect is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous {
namespace {

struct Case {
  Instance instance;
  Plan plan;
};

/// Random instances with optimal plans, in which agents often just touch.
const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> made;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      RandomInstanceOptions options;
      options.num_vertices = 12;
      options.num_agents = 5;
      options.width = 3'000 + static_cast<Length>(seed % 3) * 1'000;
      options.height = 3'000;
      options.radius = 150;
      options.mixed = seed % 2 == 1;
      if (seed % 4 == 2) options.altitude = 2'000;
      const Instance instance = random_instance(options, seed).value();
      SolveOptions solve_options;
      solve_options.limits.conflicts = 20'000;
      const SolveOutcome outcome = solve(instance, solve_options).value();
      if (outcome.plan) made.push_back({instance, *outcome.plan});
    }
    return made;
  }();
  return all;
}

/// The same with other places, agents or both.
Result<Instance> changed(const Instance& instance, auto move, auto change_agent) {
  std::vector<Point> points;
  for (const Point& p : instance.roadmap().positions()) points.push_back(move(p));
  std::vector<Agent> agents;
  for (Agent agent : instance.agents()) {
    change_agent(agent, AgentId(agents.size()));
    agents.push_back(agent);
  }
  auto roadmap = Roadmap::make(std::move(points), instance.roadmap().edges());
  if (!roadmap) return roadmap.error();
  return Instance::make(std::make_shared<const Roadmap>(std::move(roadmap).value()),
                        std::move(agents));
}

/// The body with its corners moved; a disc stays as it is.
Body moved_body(const Body& body, auto move) {
  if (std::holds_alternative<Disc>(body)) return body;
  std::vector<Point> corners;
  for (const Point& p : std::get<ConvexPolygon>(body).vertices()) corners.push_back(move(p));
  return ConvexPolygon::make(std::move(corners)).value();
}

Body scaled_body(const Body& body, std::int64_t factor) {
  if (const auto* disc = std::get_if<Disc>(&body)) return Disc{factor * disc->radius};
  return moved_body(body, [&](Point p) { return Point{factor * p.x, factor * p.y}; });
}

constexpr auto kStay = [](Point p) { return p; };

bool valid(const Instance& instance, const Plan& plan) { return verify(instance, plan).valid(); }

TEST(VerifyMetamorphic, ThereIsSomethingToCheck) {
  EXPECT_GE(cases().size(), 15u);
  for (const Case& c : cases()) EXPECT_TRUE(valid(c.instance, c.plan));
}

TEST(VerifyMetamorphic, BrokenPlansAreRejected) {
  std::mt19937_64 random(1);
  int broken = 0;
  for (const Case& c : cases())
    for (const AgentId i : c.instance.agent_ids()) {
      const Path& path = c.plan.paths[i];
      const auto rejected = [&](const Path& wrong) {
        Plan plan = c.plan;
        plan.paths[i] = wrong;
        ++broken;
        return !valid(c.instance, plan);
      };
      if (path.size() < 2) continue;
      const std::size_t k = 1 + random() % (path.size() - 1);
      Path wrong = path;
      // A move that is one tick too short or too long, at either end.
      for (const Ticks by : {Ticks{-1}, Ticks{1}}) {
        wrong = path;
        for (std::size_t later = k; later < wrong.size(); ++later) {
          wrong[later].arrive += by;
          wrong[later].depart += by;
        }
        EXPECT_TRUE(rejected(wrong));
        wrong = path;
        wrong[k - 1].depart += by;
        EXPECT_TRUE(rejected(wrong));
      }
      wrong = path;
      wrong.pop_back();
      EXPECT_TRUE(rejected(wrong));  // short of its goal: optimal paths come there once
      wrong = path;
      wrong.erase(wrong.begin());
      EXPECT_TRUE(rejected(wrong));
      wrong = path;
      wrong[k].vertex = VertexId((wrong[k].vertex.index() + 1 + random() % 11) % 12);
      EXPECT_TRUE(rejected(wrong));
      wrong = path;
      wrong.insert(wrong.begin() + static_cast<std::ptrdiff_t>(k), wrong[k]);
      EXPECT_TRUE(rejected(wrong));  // there are no loops
      wrong = path;
      wrong.back().depart += 1;
      EXPECT_TRUE(rejected(wrong));
    }
  EXPECT_GT(broken, 300);
}

TEST(VerifyMetamorphic, PathsOfOtherAgentsAreRejected) {
  for (const Case& c : cases()) {
    Plan plan = c.plan;
    std::swap(plan.paths[AgentId(0)], plan.paths[AgentId(1)]);
    EXPECT_FALSE(valid(c.instance, plan));
    plan = c.plan;
    plan.paths.push_back(plan.paths[AgentId(0)]);
    EXPECT_FALSE(valid(c.instance, plan));
  }
}

TEST(VerifyMetamorphic, MovingMirroringAndTurningTheRoadmapChangesNothing) {
  for (const Case& c : cases()) {
    const auto same = [&](auto turn, Point by) {
      const auto move = [&](Point p) {
        p = turn(p);
        return Point{p.x + by.x, p.y + by.y, p.z + by.z};
      };
      const auto turn_body = [&](Agent& agent, AgentId) {
        agent.body = moved_body(agent.body, turn);
      };
      const Instance moved = changed(c.instance, move, turn_body).value();
      const auto before = verify(c.instance, c.plan, kAllClearances);
      const auto after = verify(moved, c.plan, kAllClearances);
      EXPECT_TRUE(after.valid());
      for (std::size_t k = 0; k < before.clearances.size(); ++k)
        EXPECT_NEAR(before.clearances[k].gap, after.clearances[k].gap, 1e-9);
    };
    same([](Point p) { return p; }, {123'456'789, -987'654'321});
    same([](Point p) { return Point{-p.x, p.y, p.z}; }, {});
    same([](Point p) { return Point{p.y, p.x, p.z}; }, {});
    same([](Point p) { return Point{-p.y, p.x, p.z}; }, {});
    if (c.instance.is_flat()) continue;
    same([](Point p) { return p; }, {0, 0, 123'456'789});
    same([](Point p) { return Point{p.z, p.x, -p.y}; }, {});
  }
}

TEST(VerifyMetamorphic, TheReportedClearanceIsTheRoomThereIs) {
  int boundaries = 0;
  for (const Case& c : cases()) {
    const auto report = verify(c.instance, c.plan, kAllClearances);
    for (const Clearance& clearance : report.clearances) {
      if (!std::holds_alternative<Disc>(c.instance.agent(clearance.agent).body)) continue;
      const auto room = Length(static_cast<std::int64_t>(std::floor(clearance.gap)));
      // The one agent grows; what others have to say about that does not matter.
      const auto grown = [&](Length by) {
        return changed(c.instance, kStay, [&](Agent& agent, AgentId i) {
          if (i == clearance.agent)
            std::get<Disc>(agent.body).radius += by;
          else if (i != clearance.other)
            agent.body = Disc{1};
        });
      };
      const auto collide = [&](const Instance& instance) {
        const auto all = verify(instance, c.plan).violations;
        return std::any_of(all.begin(), all.end(), [&](const Violation& v) {
          return v.agent == clearance.agent && v.other == clearance.other;
        });
      };
      const auto fits = grown(room);
      // None: the starts or the goals of the one and others overlap.
      if (fits) {
        EXPECT_FALSE(collide(*fits)) << clearance.gap;
      }
      // A whole gap is not to be trusted to the last digit.
      const auto too_large =
          grown(room + (clearance.gap - std::floor(clearance.gap) > 0.999 ? Length{2} : Length{1}));
      if (!too_large) continue;
      EXPECT_TRUE(collide(*too_large)) << clearance.gap;
      ++boundaries;
    }
  }
  EXPECT_GT(boundaries, 50);
}

TEST(VerifyMetamorphic, ScalingSpaceAndTimeScalesTheClearance) {
  // Radii too; durations are rounded, so the edges say what they take.
  for (const Case& c : cases()) {
    if (c.instance.num_classes() > 1) continue;
    constexpr std::int64_t kFactor = 7;
    std::vector<Point> points;
    for (const Point& p : c.instance.roadmap().positions())
      points.push_back({kFactor * p.x, kFactor * p.y, kFactor * p.z});
    std::vector<Edge> edges = c.instance.roadmap().edges();
    for (std::size_t e = 0; e < edges.size(); ++e)
      edges[e].duration = kFactor * c.instance.duration(ClassId(0), EdgeId(e));
    std::vector<Agent> agents;
    for (Agent agent : c.instance.agents()) {
      agent.body = scaled_body(agent.body, kFactor);
      agents.push_back(agent);
    }
    const Instance scaled =
        Instance::make(std::make_shared<const Roadmap>(
                           Roadmap::make(std::move(points), std::move(edges)).value()),
                       std::move(agents))
            .value();
    Plan plan = c.plan;
    for (const AgentId i : c.instance.agent_ids())
      for (Stop& stop : plan.paths[i]) {
        stop.arrive *= kFactor;
        stop.depart *= kFactor;
      }
    const auto before = verify(c.instance, c.plan, kAllClearances);
    const auto after = verify(scaled, plan, kAllClearances);
    EXPECT_TRUE(after.valid());
    EXPECT_EQ(after.sum_of_costs, kFactor * before.sum_of_costs);
    for (std::size_t k = 0; k < before.clearances.size(); ++k)
      EXPECT_NEAR(kFactor * before.clearances[k].gap, after.clearances[k].gap, 1e-8);
  }
}

/// The paths as motions with their starts; the goal stays last until `end`.
std::vector<std::pair<geometry::Motion, Ticks>> motions(const Roadmap& roadmap, const Path& path,
                                                        Ticks end) {
  std::vector<std::pair<geometry::Motion, Ticks>> all;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Point at = roadmap.position(path[k].vertex);
    const bool is_last = k + 1 == path.size();
    const Ticks depart = is_last ? end : path[k].depart;
    all.emplace_back(geometry::rest(at, depart - path[k].arrive), path[k].arrive);
    if (!is_last)
      all.emplace_back(geometry::Motion{at, roadmap.position(path[k + 1].vertex),
                                        path[k + 1].arrive - path[k].depart},
                       path[k].depart);
  }
  return all;
}

TEST(VerifyMetamorphic, DelayedPlansCollideIfAndOnlyIfTheGeometrySaysSo) {
  std::mt19937_64 random(2);
  int good = 0, bad = 0;
  for (const Case& c : cases())
    for (int trial = 0; trial < 60; ++trial) {
      // Some agents wait a little longer somewhere, which keeps each path right in itself.
      Plan plan = c.plan;
      for (const AgentId i : c.instance.agent_ids()) {
        Path& path = plan.paths[i];
        if (random() % 2 == 0 || path.size() < 2) continue;
        const std::size_t k = random() % (path.size() - 1);
        const auto by = static_cast<Ticks>(random() % 2 == 0 ? random() % 5 : random() % 3'000);
        path[k].depart += by;
        for (std::size_t later = k + 1; later < path.size(); ++later) {
          path[later].arrive += by;
          path[later].depart += by;
        }
      }
      const Ticks end = as_ticks(cost(plan, Objective::makespan) + 1);
      bool collide = false;
      for (const AgentId i : c.instance.agent_ids())
        for (const AgentId j : c.instance.agent_ids()) {
          if (!(i < j)) continue;
          const geometry::BodyPair pair(c.instance.agent(i).body, c.instance.agent(j).body);
          for (const auto& [a, start_a] : motions(c.instance.roadmap(), plan.paths[i], end))
            for (const auto& [b, start_b] : motions(c.instance.roadmap(), plan.paths[j], end))
              collide = collide || pair.collide(a, b, start_b - start_a);
        }
      EXPECT_EQ(valid(c.instance, plan), !collide);
      ++(collide ? bad : good);
    }
  EXPECT_GT(good, 100);
  EXPECT_GT(bad, 100);
}

}  // namespace
}  // namespace quadrille::continuous
