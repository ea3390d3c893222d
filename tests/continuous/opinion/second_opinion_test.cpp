// SPDX-License-Identifier: MIT
//
// The two verifiers against each other.
#include "quadrille/continuous/second_opinion.hpp"

#include <gtest/gtest.h>

#include <map>

#include "continuous/support/random_instance.hpp"
#include "continuous/support/random_walk.hpp"
#include "primal/first_plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {
namespace {

using test::Draw;
using Verdict = SecondOpinion::Verdict;

class Comparison {
 public:
  void look(const Instance& instance, const Plan& plan) {
    const VerifyReport report = verify(instance, plan, kAllClearances);
    const SecondOpinion opinion = ask_fcl(instance, plan);
    EXPECT_EQ(find_contradiction(report.valid(), opinion), "");
    const auto breaks_rule = [](const Violation& v) {
      return v.kind != Violation::Kind::collision && v.kind != Violation::Kind::obstacle;
    };
    EXPECT_EQ(opinion.verdict == Verdict::broken,
              std::any_of(report.violations.begin(), report.violations.end(), breaks_rule));
    // Pair by pair.
    std::map<std::pair<AgentId, AgentId>, Encounter> said;
    for (const Meeting& m : opinion.meetings)
      if (m.other) said[{m.agent, *m.other}] = m.collide ? Encounter::collision : Encounter::touch;
    std::map<std::pair<AgentId, AgentId>, bool> collide;
    for (const Violation& v : report.violations)
      if (v.kind == Violation::Kind::collision) collide[{v.agent, *v.other}] = true;
    for (const Clearance& c : report.clearances) {
      const auto known = said.find({c.agent, c.other});
      const Encounter encounter = known == said.end() ? Encounter::clear : known->second;
      const bool exact = collide.contains({c.agent, c.other});
      EXPECT_NE(encounter, exact ? Encounter::clear : Encounter::collision);
      if (std::abs(c.gap) > opinion.tolerance) {
        EXPECT_NE(encounter, Encounter::touch) << c.gap << " against " << opinion.tolerance;
      }
    }
    if (!report.valid() && report.violations.front().kind == Violation::Kind::obstacle)
      ++num_obstacles;
    ++seen[opinion.verdict];
  }

  int num_obstacles = 0;  // plans in which somebody is hit by one first of all
  std::map<Verdict, int> seen;

 private:
  using Encounter = geometry::Encounter;
};

/// Changes one path: in most cases it keeps all rules of its own.
void tamper(Draw& draw, const Instance& instance, Plan& plan) {
  const auto some = [&](std::size_t count) {
    return static_cast<std::size_t>(draw.number(0, static_cast<std::int64_t>(count) - 1));
  };
  Path& path = plan.paths[AgentId(some(instance.num_agents()))];
  if (path.size() < 2) return;
  const std::size_t k = some(path.size() - 1);
  const Ticks by = draw.chance(50) ? Ticks{1} : draw.ticks(1, 40);
  switch (draw.number(0, 9)) {
    case 0:  // another duration
      path[k].depart += by;
      break;
    case 1:  // another place
      path[k + 1].vertex = VertexId(some(instance.roadmap().num_vertices()));
      break;
    default:  // a longer wait
      path[k].depart += by;
      for (std::size_t later = k + 1; later < path.size(); ++later) {
        path[later].arrive += by;
        path[later].depart += by;
      }
  }
}

// 10,000 plans.
TEST(SecondOpinion, AgreesWithVerifyOnPlansGoodAndTampered) {
  Comparison comparison;
  const auto num_instances = static_cast<std::uint32_t>(support::scaled(1000));
  for (std::uint32_t seed = 0; seed < num_instances; ++seed) {
    test::RandomOptions random;
    random.num_agents = 2 + seed % 3;
    random.polygon_percent = seed % 2 == 0 ? 20 : 60;
    random.obstacles_percent = random.leaves_percent = random.release_percent = 25;
    if (seed % 4 == 3) random.size = 20'000, random.max_radius = 4'000;
    const Instance instance = test::random_instance(seed, random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << test::describe(instance));
    Draw draw(seed);
    Plan plan;
    LimitMonitor limits({});
    Scene scene(instance, limits);
    const auto good = find_first_plan(scene);
    if (good) {
      comparison.look(instance, *good);
      for (int k = 0; k < 4; ++k) {
        plan = *good;
        tamper(draw, instance, plan);
        comparison.look(instance, plan);
      }
    }
    for (int k = good ? 5 : 0; k < 10; ++k) {
      plan = {};
      for (const AgentId i : instance.agent_ids())
        plan.paths.push_back(test::draw_path(draw, instance, i));
      comparison.look(instance, plan);
    }
    if (HasFailure()) return;
  }
  const int few = static_cast<int>(num_instances) / 4;
  for (const Verdict verdict : {Verdict::clear, Verdict::collision, Verdict::broken})
    EXPECT_GT(comparison.seen[verdict], few) << to_string(verdict);
  // A few instances need not have any.
  if (num_instances >= 100) {
    EXPECT_GT(comparison.seen[Verdict::touch], few / 10);
    EXPECT_GT(comparison.num_obstacles, few / 10);
  }
  for (const auto& [verdict, count] : comparison.seen)
    RecordProperty(std::string(to_string(verdict)), count);
}

}  // namespace
}  // namespace quadrille::continuous
