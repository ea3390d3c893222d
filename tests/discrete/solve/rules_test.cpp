// SPDX-License-Identifier: MIT
// Rules: random instances of each kind and of mixtures, all systems against the joint search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/case_text.hpp"
#include "support/environment.hpp"
#include "support/ruled_search.hpp"
#include "support/solver_cases.hpp"

namespace quadrille::discrete::support {
namespace {

using quadrille::support::scaled;

std::string text_of(const Instance& instance, const TunedOptions& options) {
  std::ostringstream out;
  static_cast<void>(write_instance_json(out, "", instance, {}));
  return out.str() + options_text(options);
}

/// The other systems do not know all of it.
bool needs_dpll(const Instance& instance) {
  if (instance.poses()) return true;
  for (const Agent& agent : instance.agents())
    if (!agent.waypoints.empty()) return true;
  return false;
}

/// A search ends, although there is no plan.
bool ends_without_plan(const Instance& instance) {
  bool has_deadlines = true;
  for (const Agent& agent : instance.agents()) has_deadlines &= agent.deadline.has_value();
  return has_deadlines || !check_feasibility(instance.relaxed()).feasible;
}

struct Count {
  int solved = 0, infeasible = 0;
};

void compare(const Instance& instance, Random& random, const std::string& origin, Count& count) {
  const Objective objective = random.percent(60) ? Objective::sum_of_costs : Objective::makespan;
  const JointAnswer expected = joint_search(instance, objective, 300'000);
  if (expected.status == Status::unknown) return;
  if (expected.status == Status::infeasible && !ends_without_plan(instance)) return;
  if (expected.status == Status::optimal) {
    ASSERT_EQ(replay_rules(instance, expected.plan), "") << origin;
    const VerifyReport report = verify(instance, expected.plan);
    ASSERT_TRUE(report.valid()) << origin << ": " << report.violations[0].message << "\n"
                                << text_of(instance, {});
  }
  for (TunedOptions& options : random_systems(random, objective)) {
    if (options.system != System::dpll && needs_dpll(instance)) continue;
    const bool is_solvable = expected.status == Status::optimal;
    if (options.debug.known_plan) {
      options.debug.known_plan.reset();
      if (is_solvable) options.debug.known_plan = expected.plan;
    }
    if (options.initial_plan) {
      options.initial_plan.reset();
      if (is_solvable) options.initial_plan = expected.plan;
    }
    const auto outcome = solve(instance, options);
    ASSERT_TRUE(outcome) << origin << ": " << outcome.error().message;
    const std::string fault = find_fault(instance, options, *outcome, expected);
    ASSERT_EQ(fault, "") << origin << "\nexpected " << to_string(expected.status) << " "
                         << expected.cost << ", answered " << to_string(outcome->status) << " "
                         << outcome->cost.value_or(-1) << " bound " << outcome->lower_bound << " "
                         << outcome->explanation << "\n"
                         << text_of(instance, options);
    ++count.solved;
  }
  count.infeasible += expected.status == Status::infeasible ? 1 : 0;
}

struct Kind {
  const char* name;
  std::uint64_t seed;
  RuleKinds kinds;
  bool is_mixed = false, has_goal_sets = false;
};

Instance draw(Random& random, const Kind& kind) {
  Instance plain = kind.kinds.turning || random.percent(50) ? random_grid(random, {1, 3, 30, 2, 3})
                                                            : random_graph(random, 7, 3);
  if (kind.has_goal_sets) plain = with_group_goals(random, plain);
  RuleKinds kinds = kind.kinds;
  if (kind.is_mixed)
    kinds = {random.percent(50), random.percent(50), random.percent(50), random.percent(50),
             random.percent(30), random.percent(30), random.percent(20)};
  return with_random_rules(random, plain, kinds);
}

class RulesRandom : public testing::TestWithParam<Kind> {};

TEST_P(RulesRandom, AllSystemsAnswerAsTheJointSearch) {
  Count count;
  for (std::size_t number = 0; number < scaled(400); ++number) {
    Random random(GetParam().seed + number);
    const Instance instance = draw(random, GetParam());
    compare(instance, random, std::string(GetParam().name) + " " + std::to_string(number), count);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(count.solved, static_cast<int>(scaled(300)));
  RecordProperty("solved", count.solved);
  RecordProperty("infeasible", count.infeasible);
}

/// A walk at random, mostly along edges, that ends somewhere.
Path random_path(Random& random, const Graph& graph, VertexId start) {
  Path path{start};
  for (std::size_t steps = random.below(7); steps > 0; --steps) {
    const auto near = graph.neighbours(path.back());
    path.push_back(near.empty() || random.percent(35) ? path.back()
                                                      : near[random.below(near.size())]);
    if (random.percent(2)) path.back() = VertexId(random.below(graph.num_vertices()));
  }
  return path;
}

// Plans that are good, nearly good, and bad: verify and the definition agree.
TEST_P(RulesRandom, VerifyAgreesWithTheDefinition) {
  int valid = 0, invalid = 0;
  for (std::size_t number = 0; number < scaled(600); ++number) {
    Random random(GetParam().seed + 500'000 + number);
    const Instance instance = draw(random, GetParam());
    Plan good = joint_search(instance, Objective::sum_of_costs, 20'000).plan;
    for (int round = 0; round < 20; ++round) {
      Plan plan = good;
      if (plan.paths.empty() || random.percent(20)) {
        plan.paths = {};
        for (const Agent& agent : instance.agents())
          plan.paths.push_back(random_path(random, instance.graph(), agent.start));
      } else if (round > 0) {
        const AgentId i(random.below(plan.paths.size()));
        Path& path = plan.paths[i];
        const auto at = static_cast<std::ptrdiff_t>(random.below(path.size()));
        if (random.percent(60))
          path.insert(path.begin() + at, path[static_cast<std::size_t>(at)]);
        else if (path.size() > 1)
          path.erase(path.begin() + at);
      }
      const std::string fault = replay_rules(instance, plan);
      const VerifyReport report = verify(instance, plan);
      ASSERT_EQ(report.valid(), fault.empty())
          << GetParam().name << " " << number << ": " << fault << ", "
          << (report.valid() ? "valid" : report.violations[0].message) << "\n"
          << text_of(instance, {});
      ++(report.valid() ? valid : invalid);
    }
  }
  EXPECT_GT(valid, static_cast<int>(scaled(500)));
  EXPECT_GT(invalid, static_cast<int>(scaled(500)));
}

TEST_P(RulesRandom, AreReadAsTheyWereWritten) {
  for (std::size_t number = 0; number < 200; ++number) {
    Random random(GetParam().seed + 700'000 + number);
    const Instance instance = draw(random, GetParam());
    std::ostringstream out;
    ASSERT_FALSE(write_instance_json(out, "", instance, {}));
    std::istringstream in(out.str());
    const auto again = read_instance_json(in, "written.json", SIZE_MAX);
    ASSERT_TRUE(again) << again.error().to_string() << "\n" << out.str();
    EXPECT_EQ(again->agents(), instance.agents());
    EXPECT_EQ(again->rules(), instance.rules());
    for (const VertexId v : IdRange<VertexId>(instance.graph().num_vertices()))
      EXPECT_TRUE(std::ranges::equal(again->graph().neighbours(v), instance.graph().neighbours(v)));
  }
}

// Where the search for the bound gets no time, plans are those of prioritised planning, and made
// cheaper: valid ones, for most instances.
TEST_P(RulesRandom, FirstPlansKeepAllRules) {
  int found = 0, asked = 0;
  for (std::size_t number = 0; number < scaled(60); ++number) {
    Random random(GetParam().seed + 900'000 + number);
    const Instance plain = random_grid(random, {7, 10, 15, 5, 12});
    const Instance instance = with_random_rules(random, plain, GetParam().kinds);
    if (instance.is_plain()) continue;
    SolveOptions options;
    options.objective = random.percent(50) ? Objective::sum_of_costs : Objective::makespan;
    options.limits.conflicts = 1;
    options.threads = random.percent(25) ? 2 : 1;
    const auto outcome = solve(instance, options);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message << "\n"
                                          << text_of(instance, {});
    if (outcome->status == Status::infeasible) continue;
    ++asked;
    if (!outcome->plan) continue;
    ASSERT_EQ(replay_rules(instance, *outcome->plan), "") << text_of(instance, {});
    found += outcome->statistics.first_plan == "prioritised" ? 1 : 0;
  }
  RecordProperty("found", found);
  RecordProperty("asked", asked);
  EXPECT_GE(2 * found, asked) << found << " of " << asked;
}

INSTANTIATE_TEST_SUITE_P(Kinds, RulesRandom,
                         testing::Values(Kind{"leaving", 1'000'000, {.leaving = true}},
                                         Kind{"times", 2'000'000, {.times = true}},
                                         Kind{"one_way", 3'000'000, {.one_way = true}},
                                         Kind{"blockages", 4'000'000, {.blockages = true}},
                                         Kind{"robust", 5'000'000, {.robust = true}},
                                         Kind{"waypoints", 6'000'000, {.waypoints = true}},
                                         Kind{"turning", 8'000'000, {.turning = true}},
                                         Kind{"mixed", 7'000'000, {}, true},
                                         Kind{"goal_sets", 9'000'000, {}, true, true}),
                         [](const auto& drawn) { return std::string(drawn.param.name); });

Instance read(const std::string& text) {
  std::istringstream in(text);
  return read_instance_json(in, "text.json", SIZE_MAX).value();
}

constexpr const char* kCrossing =
    R"("grid":{"width":4,"height":4,"rows":[".@..","..@.","@.@.","...."]})";

Cost least_cost(const std::string& text) {
  SolveOptions options;
  const SolveOutcome outcome = solve(read(text), options).value();
  EXPECT_EQ(outcome.status, Status::optimal) << outcome.explanation;
  return outcome.cost.value_or(-1);
}

std::string instance(const std::string& inside) {
  return R"({"quadrille":"instance","version":1,)" + inside + "}";
}

// Values by hand, or by a joint search that is no part of this project.
TEST(Rules, KnownValues) {
  const std::string crossing = kCrossing;
  const std::string agents =
      R"("agents":[{"start":[1,2],"goal":[2,3]},{"start":[3,2],"goal":[1,3]}])";
  EXPECT_EQ(least_cost(instance(crossing + "," + agents)), 10);
  EXPECT_EQ(least_cost(instance(crossing + R"(,"robust":1,)" + agents)), 13);
  EXPECT_EQ(
      least_cost(instance(crossing + R"(,"agents":[{"start":[1,2],"goal":[2,3],"at_goal":"leave"},)"
                                     R"({"start":[3,2],"goal":[1,3],"at_goal":"leave"}])")),
      6);
  EXPECT_EQ(least_cost(instance(
                R"("graph":{"vertices":4,"edges":[[0,1],[1,2],[2,3],[3,0]],"directed":true},)"
                R"("agents":[{"start":0,"goal":2},{"start":2,"goal":0}])")),
            4);
}

// A line of four: whoever is in the way has to go first.
TEST(Rules, ObstaclesOnTheWay) {
  const std::string line =
      R"("graph":{"vertices":4,"edges":[[0,1],[1,2],[2,3]]},"agents":[{"start":0,"goal":3}])";
  EXPECT_EQ(least_cost(instance(line)), 3);
  EXPECT_EQ(least_cost(instance(line + R"(,"obstacles":[{"vertex":1,"first":1,"last":4}])")), 7);
  EXPECT_EQ(least_cost(instance(line + R"(,"obstacles":[{"edge":[2,1],"first":1,"last":1}])")), 4);
  // It comes towards the agent as far as the middle and goes back: who waits at the end gets by.
  EXPECT_EQ(least_cost(instance(
                line + R"(,"obstacles":[{"path":[{"vertex":3,"arrive":0},{"vertex":2,"arrive":1},)"
                       R"({"vertex":3,"arrive":2,"depart":5}],"at_end":"leave"}])")),
            6);
}

/// "kind timestep" of all violations of paths of vertex numbers.
std::string broken(const Instance& instance, const std::vector<std::vector<std::size_t>>& paths) {
  Plan plan;
  for (const auto& numbers : paths) {
    Path path;
    for (const std::size_t v : numbers) path.emplace_back(v);
    plan.paths.push_back(path);
  }
  std::string text;
  for (const Violation& violation : verify(instance, plan).violations)
    text += std::string(to_string(violation.kind)) + " " + std::to_string(violation.timestep) + ";";
  return text;
}

TEST(Rules, VerifySaysWhatIsBroken) {
  const std::string line = R"("graph":{"vertices":4,"edges":[[0,1],[1,2],[2,3]]},)";
  const Instance one = read(instance(
      line + R"("obstacles":[{"vertex":2,"first":2,"last":3},{"edge":[1,0],"first":4}],)"
             R"("agents":[{"start":0,"goal":3,"release":2,"deadline":5,"waypoints":[1]}])"));
  EXPECT_EQ(broken(one, {{0, 1, 2, 3}}), "too-early 0;too-early 1;obstacle 2;");
  EXPECT_EQ(broken(one, {{0, 0, 0, 1, 2, 3}}), "");
  EXPECT_EQ(broken(one, {{0, 0, 0, 1, 1, 2, 3}}), "too-late 6;");
  EXPECT_EQ(broken(one, {{0, 0, 0, 0, 0, 1, 2, 3}}), "obstacle 4;too-late 7;");
  const Instance back = read(instance(
      line + R"("agents":[{"start":0,"goal":2,"waypoints":[3]},{"start":1,"goal":3}],"robust":1)"));
  EXPECT_EQ(broken(back, {{0, 1, 2}, {1, 2, 3}}), "too-close 1;waypoint 2;too-close 2;");
  const Instance gone = read(
      instance(line + R"("agents":[{"start":1,"goal":2,"at_goal":"leave"},{"start":0,"goal":3}])"));
  EXPECT_EQ(broken(gone, {{1, 2, 2, 2}, {0, 1, 2, 3}}), "");
  EXPECT_EQ(broken(gone, {{1, 1, 2}, {0, 0, 1, 2, 3}}), "");
  EXPECT_EQ(broken(gone, {{1, 1, 2}, {0, 1, 2, 3}}), "vertex-conflict 1;vertex-conflict 2;");
  const Instance one_way = read(instance(
      R"("graph":{"vertices":2,"edges":[[0,1]],"directed":true},"agents":[{"start":0,"goal":0}])"));
  EXPECT_EQ(broken(one_way, {{0, 1, 0}}), "not-adjacent 1;");
}

TEST(Rules, SaysWhoIsStuck) {
  const SolveOutcome outcome =
      solve(read(instance(R"("graph":{"vertices":3,"edges":[[0,1],[1,2]]},)"
                          R"("agents":[{"start":0,"goal":2,"release":4,"deadline":5}])")),
            SolveOptions())
          .value();
  EXPECT_EQ(outcome.status, Status::infeasible);
  EXPECT_EQ(outcome.explanation,
            "agent 0 has no way from 0 to 2 that keeps the rules, even if it is alone; its "
            "deadline is one of them");
}

TEST(Rules, AreRefusedWhereTheyAreNotKnown) {
  const Instance ruled = read(instance(R"("graph":{"vertices":3,"edges":[[0,1],[1,2]]},)"
                                       R"("agents":[{"start":0,"goal":2,"waypoints":[1]}])"));
  SolveOptions options;
  options.proof = true;
  EXPECT_FALSE(solve(ruled, options));
  options.proof = false;
  options.explain = true;
  EXPECT_FALSE(solve(ruled, options));
  options.explain = false;
  EXPECT_TRUE(solve(ruled, options));
  options.system = System::smt_cbs;
  const auto refused = solve(ruled, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "the system smt-cbs knows no waypoints and no turns; they need the system dpll");
}

TEST(Rules, TurnsByHand) {
  const std::string field = R"("grid":{"width":3,"height":3,"rows":["...","...","..."]},"turn":2,)";
  // East, two quarter turns or one, and ahead.
  EXPECT_EQ(least_cost(instance(field + R"("agents":[{"start":[0,0],"goal":[2,0]}])")), 2);
  EXPECT_EQ(least_cost(instance(field + R"("agents":[{"start":[0,0],"goal":[2,2]}])")), 6);
  EXPECT_EQ(least_cost(instance(field + R"("agents":[{"start":[2,0],"goal":[0,0]}])")), 6);
  EXPECT_EQ(
      least_cost(instance(field + R"("agents":[{"start":[2,0],"goal":[0,0],"heading":"west"}])")),
      2);
  EXPECT_EQ(
      least_cost(instance(field + R"("agents":[{"start":[0,2],"goal":[0,0],"heading":"west"}])")),
      4);
  const Instance corner = read(instance(field + R"("agents":[{"start":[0,0],"goal":[2,2]}])"));
  EXPECT_EQ(broken(corner, {{0, 1, 2, 2, 2, 5, 8}}), "");
  EXPECT_EQ(broken(corner, {{0, 1, 2, 2, 5, 8}}), "no-time-to-turn 3;");
}

// Where orders of agents do not lead to a plan, turns are added to one without them, also to those
// that go round in circles.
TEST(Rules, CrowdsThatTurnHavePlans) {
  int asked = 0, added = 0;
  for (std::size_t number = 0; number < scaled(60); ++number) {
    Random random(8'800'000 + number);
    const Instance plain = random_grid(random, {4, 6, 10, 10, 22});
    const Instance instance = with_random_rules(random, plain, {.turning = true});
    if (!instance.poses()) continue;
    SolveOptions options;
    options.limits.conflicts = 1;
    const auto outcome = solve(instance, options);
    ASSERT_TRUE(outcome) << outcome.error().message;
    ASSERT_FALSE(outcome->internal_error) << outcome->internal_error->message << "\n"
                                          << text_of(instance, {});
    if (outcome->status == Status::infeasible) continue;
    ++asked;
    ASSERT_TRUE(outcome->plan) << text_of(instance, {});
    ASSERT_EQ(replay_rules(instance, *outcome->plan), "") << text_of(instance, {});
    added += outcome->statistics.first_plan == "turns added" ? 1 : 0;
  }
  RecordProperty("asked", asked);
  RecordProperty("added", added);
  EXPECT_GT(added, 0);
}

TEST(Rules, TurnsNeedAGridAndHeadingsNeedTurns) {
  const auto error_of = [](const std::string& text) {
    std::istringstream in(instance(text));
    const auto read = read_instance_json(in, "text.json", SIZE_MAX);
    return read ? "" : read.error().message;
  };
  const std::string graph = R"("graph":{"vertices":2,"edges":[[0,1]]},)";
  const std::string grid = R"("grid":{"width":2,"height":1,"rows":[".."]},)";
  const std::string east = R"("agents":[{"start":[0,0],"goal":[1,0],"heading":"east"}])";
  EXPECT_EQ(error_of(graph + R"("turn":1,"agents":[{"start":0,"goal":1}])"),
            "/turn: turns take time on a grid only");
  EXPECT_EQ(error_of(grid + R"("turn":17,)" + east), "/turn: 17 is not between 1 and 16");
  EXPECT_EQ(error_of(grid + east),
            "/agents/0/heading: agents have headings only where there is the key 'turn'");
  EXPECT_EQ(error_of(grid + R"("turn":1,"agents":[{"start":[0,0],"goal":[1,0],"heading":"up"}])"),
            "/agents/0/heading: expected 'east', 'south', 'west' or 'north', found 'up'");
  EXPECT_EQ(error_of(grid + R"("turn":1,)" + east), "");
  Rules rules;
  rules.turn = 1;
  const Instance plain = read(instance(graph + R"("agents":[{"start":0,"goal":1}])"));
  EXPECT_EQ(plain.with_rules(rules).error().code, ErrorCode::invalid_instance);
  rules.turn = kMaxTurn + 1;
  EXPECT_EQ(plain.with_rules(rules).error().code, ErrorCode::out_of_range);
}

// Times are absolute.
TEST(Rules, BeginWithTheInstance) {
  const std::string late =
      R"("now":100,"graph":{"vertices":3,"edges":[[0,1],[1,2]]},)"
      R"("obstacles":[{"vertex":1,"first":90,"last":103},{"vertex":0,"last":99}],)"
      R"("agents":[{"start":0,"goal":2,"release":101,"deadline":106}])";
  EXPECT_EQ(least_cost(instance(late)), 5);
}

}  // namespace
}  // namespace quadrille::discrete::support
