// SPDX-License-Identifier: MIT
// Settings say how long a solve takes, never what is true: with all of them drawn at random the
// answers are the same, in both domains.
#include "quadrille/core/settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "continuous/support/random_instance.hpp"
#include "faults/instances.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"

namespace quadrille::support {
namespace {

/// A third of them: the least or the largest value, or one of the orders of magnitude up to twice
/// the usual one.
Settings draw_settings(Random& random, std::string& text) {
  Settings settings;
  for (const SettingInfo& info : settings_table()) {
    if (!random.percent(33)) continue;
    std::int64_t& value = settings.*info.value;
    const std::int64_t least = info.least;
    const std::size_t kind = random.below(4);
    if (kind == 0) {
      value = least;
    } else if (kind == 1) {
      value = info.most;
    } else {
      std::int64_t most = 2 * value;
      for (std::size_t digits = random.below(7); digits > 0 && most > 8; --digits) most /= 10;
      value =
          std::clamp(static_cast<std::int64_t>(random.below(static_cast<std::size_t>(most + 1))),
                     least, info.most);
    }
    text += std::string(info.name) + "=" + std::to_string(value) + " ";
  }
  return settings;
}

template <class Instance, class Options>
void expect_same_answers(const Instance& instance, Options options, Random& random) {
  options.limits.conflicts = 3000;
  const auto usual = solve(instance, options).value();
  std::string text;
  options.settings = draw_settings(random, text);
  SCOPED_TRACE(text);
  options.debug.audit = random.percent(20);
  const auto drawn = solve(instance, options).value();
  ASSERT_FALSE(drawn.internal_error) << drawn.internal_error->message;
  if (drawn.plan) {
    ASSERT_TRUE(verify(instance, *drawn.plan).valid());
  }
  if (usual.cost) {
    ASSERT_LE(drawn.lower_bound, *usual.cost);
  }
  if (drawn.cost) {
    ASSERT_LE(usual.lower_bound, *drawn.cost);
  }
  const auto is_proof = [](Status s) { return s == Status::optimal || s == Status::infeasible; };
  if (!is_proof(usual.status) || !is_proof(drawn.status)) return;
  ASSERT_EQ(usual.status, drawn.status);
  ASSERT_EQ(usual.cost, drawn.cost);
}

TEST(Settings, ChangeNoAnswerOnGraphs) {
  for (std::uint64_t seed = 1; seed <= scaled(600); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    discrete::SolveOptions options;
    options.objective = random.percent(30) ? Objective::makespan : Objective::sum_of_costs;
    options.threads = random.percent(20) ? 2 : 1;
    discrete::support::GridShape shape;
    shape.max_agents = 7;
    expect_same_answers(random.percent(40) ? discrete::support::random_graph(random, 9, 5)
                                           : discrete::support::random_grid(random, shape),
                        options, random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Settings, ChangeNoAnswerOnRoadmaps) {
  for (std::uint32_t seed = 1; seed <= scaled(60); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    continuous::test::RandomOptions shape;
    shape.num_vertices = 6 + seed % 4;
    shape.num_agents = 3 + seed % 3;
    shape.edge_percent = 55;
    shape.size = 60;
    shape.max_radius = 6;
    continuous::SolveOptions options;
    options.objective = random.percent(30) ? Objective::makespan : Objective::sum_of_costs;
    options.threads = random.percent(20) ? 2 : 1;
    options.limits.looks = 5000;
    // By clauses, else there is little to be set.
    if (random.percent(80)) options.joint_work = options.route_work = 0;
    expect_same_answers(continuous::test::random_instance(seed, shape), options, random);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Only the second thread draws costs around the last ones; what it finds changes what the first one
// does.
TEST(Settings, ReachTheSecondThreadOnRoadmaps) {
  const continuous::Instance instance = discs(60, 20, 4);
  const auto decisions = [&](std::int64_t kept_percent) {
    continuous::SolveOptions options;
    options.threads = 2;
    options.joint_work = options.route_work = 0;
    options.limits.conflicts = 4000;
    options.settings.cover_kept_percent = kept_percent;
    return solve(instance, options).value().statistics.decisions;
  };
  EXPECT_NE(decisions(0), decisions(85));
}

}  // namespace
}  // namespace quadrille::support
