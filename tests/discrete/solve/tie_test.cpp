// SPDX-License-Identifier: MIT
// The fewest moves among plans of least cost: all systems against the joint search over pairs of
// costs and moves.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/ruled_search.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

std::string text_of(const Instance& instance, const SolveOptions& options) {
  std::ostringstream out;
  static_cast<void>(write_instance_json(out, "", instance, {}));
  return out.str() + std::string(to_string(options.system)) + " " +
         std::string(to_string(options.objective));
}

/// Rooms with a corner to spare, graphs with cycles of odd length, and rules but for waypoints.
Instance draw(Random& random, bool has_rules) {
  const Instance plain =
      random.percent(50) ? random_grid(random, {2, 3, 30, 2, 3}) : random_graph(random, 7, 3);
  if (!has_rules) return plain;
  return with_random_rules(random, plain,
                           {random.percent(40), random.percent(40), random.percent(50),
                            random.percent(40), random.percent(25), false});
}

struct Count {
  int solved = 0, needs_more = 0;
};

void compare(const Instance& instance, Random& random, Count& count) {
  const Objective objective = random.percent(60) ? Objective::sum_of_costs : Objective::makespan;
  const Cheapest expected = fewest_moves_search(instance, objective, 200'000);
  if (expected.status != Status::optimal) return;
  for (TunedOptions& options : random_systems(random, objective)) {
    if (options.debug.known_plan) options.debug.known_plan.reset();
    if (options.initial_plan) options.initial_plan.reset();
    options.gap_percent.reset();
    options.limits = {};
    options.tie = Tie::fewest_moves;
    const auto outcome = solve(instance, options);
    ASSERT_TRUE(outcome) << outcome.error().message;
    const std::string text = text_of(instance, options);
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message << "\n" << text;
    ASSERT_EQ(outcome->status, Status::optimal) << text;
    EXPECT_EQ(outcome->cost, expected.cost) << text;
    ASSERT_TRUE(outcome->moves) << text;
    EXPECT_EQ(*outcome->moves, (Moves{expected.moves, expected.moves, true}))
        << outcome->moves->number << " " << outcome->moves->lower_bound << "\n"
        << text;
    EXPECT_EQ(num_moves(*outcome->plan), expected.moves) << text;
    EXPECT_EQ(replay_rules(instance, *outcome->plan), "") << text;
    EXPECT_TRUE(verify(instance, *outcome->plan).valid()) << text;
    if (testing::Test::HasFailure()) return;
    ++count.solved;
  }
  std::int64_t alone = 0;
  for (const Agent& agent : instance.agents())
    alone += distances_to_nearest(instance.graph(), agent.goal())[agent.start];
  count.needs_more += expected.moves > alone ? 1 : 0;
}

void compare_many(std::uint64_t seed, bool has_rules) {
  Count count;
  for (std::size_t number = 0; number < scaled(1000); ++number) {
    Random random(seed + number);
    compare(draw(random, has_rules), random, count);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(count.solved, static_cast<int>(scaled(1500)));
  EXPECT_GT(count.needs_more, static_cast<int>(scaled(60)));
  testing::Test::RecordProperty("solved", count.solved);
  testing::Test::RecordProperty("needs_more", count.needs_more);
}

TEST(FewestMovesRandom, AllSystemsAnswerAsTheJointSearch) { compare_many(710'000, false); }
TEST(FewestMovesRandom, AllSystemsAnswerAsTheJointSearchUnderRules) { compare_many(720'000, true); }

// Whatever cuts it short: what is said of the moves is true.
TEST(FewestMoves, CutShortAnywhere) {
  int proved = 0, open = 0;
  for (std::size_t number = 0; number < scaled(20); ++number) {
    Random random(730'000 + number);
    const Instance instance = draw(random, false);
    SolveOptions options;
    const Cheapest expected = fewest_moves_search(instance, options.objective, 200'000);
    if (expected.status != Status::optimal) continue;
    options.tie = Tie::fewest_moves;
    for (std::int64_t looks = 1; looks < 40; ++looks) {
      options.limits.looks = looks;
      const auto outcome = solve(instance, options);
      ASSERT_TRUE(outcome && !outcome->internal_error);
      EXPECT_EQ(outcome->moves.has_value(), outcome->plan.has_value());
      if (!outcome->plan) continue;
      const Moves& moves = *outcome->moves;
      EXPECT_EQ(moves.number, num_moves(*outcome->plan));
      EXPECT_LE(moves.lower_bound, expected.moves);
      EXPECT_TRUE(outcome->status != Status::optimal || moves.number >= expected.moves);
      EXPECT_TRUE(!moves.is_proved || moves.number == expected.moves);
      EXPECT_TRUE(!moves.is_proved || outcome->status == Status::optimal);
      ++(moves.is_proved ? proved : open);
    }
  }
  EXPECT_GT(proved, 0);
  if (scaled(20) >= 20) {  // else too few to count on chance
    EXPECT_GT(open, 0);
  }
}

Result<SolveOutcome> solve_text(const std::string& text, const SolveOptions& options) {
  std::istringstream in(text);
  const auto named = read_instance_json(in, "");
  EXPECT_TRUE(named) << named.error().message;
  return solve(*named, options);
}

// An agent waits for another one where it could also take a way round of the same length.
TEST(FewestMoves, WaitingIsNoMove) {
  const std::string text = R"({"quadrille": "instance", "version": 1,
    "graph": {"vertices": 5, "edges": [[0, 1], [1, 2], [0, 3], [3, 4], [4, 2]]},
    "obstacles": [{"vertex": 1, "first": 1, "last": 1}],
    "agents": [{"start": 0, "goal": 2}]})";
  SolveOptions options;
  options.tie = Tie::fewest_moves;
  const auto outcome = solve_text(text, options);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->cost, 3);
  EXPECT_EQ(outcome->moves, (Moves{2, 2, true}));
  EXPECT_FALSE(solve_text(text, {})->moves);
}

// A claim that a dear plan is optimal holds, or is refuted; it is no error of the program.
TEST(FewestMoves, WrongClaims) {
  int refuted = 0, held = 0;
  for (std::size_t number = 0; number < scaled(200); ++number) {
    Random random(740'000 + number);
    const Instance instance = draw(random, number % 2 == 1);
    SolveOptions options;
    // Without a plan the search may have no end.
    if (fewest_moves_search(instance, options.objective, 50'000).status != Status::optimal)
      continue;
    const auto best = solve(instance, options);
    ASSERT_TRUE(best && best->plan);
    Plan dear = *best->plan;
    const AgentId slow(random.below(instance.num_agents()));
    const VertexId start = dear.paths[slow].front();
    dear.paths[slow].insert(dear.paths[slow].begin(), {start, start});
    if (!verify(instance, dear).valid()) continue;
    options.initial_plan = dear;
    options.known_lower_bound = dear.cost(options.objective);
    options.tie = Tie::fewest_moves;
    const auto outcome = solve(instance, options);
    if (!outcome) {
      EXPECT_EQ(outcome.error().code, ErrorCode::out_of_range);
      ++refuted;
      continue;
    }
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message;
    ASSERT_TRUE(outcome->plan && outcome->moves);
    EXPECT_EQ(outcome->moves->number, num_moves(*outcome->plan));
    EXPECT_LE(outcome->moves->number, num_moves(dear));
    ++held;
  }
  EXPECT_GT(held, 0);
  RecordProperty("refuted", refuted);
}

TEST(FewestMoves, RefusesWhatItIsNotFor) {
  const std::string text = R"({"quadrille": "instance", "version": 1,
    "graph": {"vertices": 3, "edges": [[0, 1], [1, 2]]}, "agents": [)";
  SolveOptions options;
  options.tie = Tie::fewest_moves;
  EXPECT_EQ(solve_text(text + R"({"start": 0, "goals": [1, 2]}]})", options).error().code,
            ErrorCode::out_of_range);
  EXPECT_EQ(
      solve_text(text + R"({"start": 0, "goal": 2, "waypoints": [1]}]})", options).error().code,
      ErrorCode::out_of_range);
  options.gap_percent = 0;
  EXPECT_EQ(solve_text(text + R"({"start": 0, "goal": 2}]})", options).error().code,
            ErrorCode::out_of_range);
}

}  // namespace
}  // namespace quadrille::discrete::support
