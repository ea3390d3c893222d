// SPDX-License-Identifier: MIT
// Certificates in continuous time: each is verified, proves what the solver says, is true of known
// plans, and cannot be broken in a way that proves more than what is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "check/timed_support.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/whole_places.hpp"
#include "quadrille/continuous/session.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/core/grouping.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
using quadrille_check::Int;
using quadrille_check::Record;
using quadrille_check::Road;
using quadrille_check::support::Answer;
using quadrille_check::support::ask;
using quadrille_check::support::bytes_of;
using quadrille_check::support::checked;
using quadrille_check::support::mutate;
using quadrille_check::support::records_of;
using quadrille_check::support::text_of;
using quadrille_check::support::TimedInterpretation;

struct Case {
  Instance instance;
  SolveOptions options;
};

Case draw(std::uint32_t seed) {
  Random random(seed);
  RandomOptions asked;
  asked.shapes_percent = asked.no_waiting_percent = 0;  // refused
  asked.num_agents = 2 + seed % 4;
  asked.num_vertices = 4 + seed / 4 % 8;
  asked.edge_percent = 30 + static_cast<int>(seed / 8 % 3) * 15;
  asked.under_way_percent = 10;
  asked.max_radius = 6;
  // The checker reads no places between whole coordinates.
  auto placed = in_whole_places(random_instance(seed, asked));
  if (!placed) {  // too large: nobody is under way
    asked.under_way_percent = 0;
    placed = random_instance(seed, asked);
  }
  Case drawn{std::move(placed).value(), {}};
  drawn.options.proof = true;
  drawn.options.seed = static_cast<std::uint32_t>(random.below(3));
  if (random.percent(25)) drawn.options.objective = Objective::makespan;
  if (random.percent(15)) drawn.options.system = System::smt_cbs;
  if (random.percent(10)) drawn.options.threads = random.between(2, 4);
  if (random.percent(50)) drawn.options.joint_work = 0;
  if (random.percent(50)) drawn.options.route_work = 0;
  drawn.options.limits.conflicts = 2000;
  drawn.options.limits.looks = 3000;
  return drawn;
}

/// Of the certificate's clauses, those that are false in a plan.
std::string find_false_clause(const Road& road, const std::string& certificate,
                              const Instance& instance, const Plan& plan) {
  quadrille_check::TimedChecker checker(road);
  const TimedInterpretation known(checker.meanings(), instance, plan);
  Int clause = 0;
  for (const Record& record : records_of(certificate)) {
    checker.check(record);
    if (record.tag != 'a' && record.tag != 'l') continue;
    ++clause;
    if (!known.is_true(record.tag == 'a' ? record.literals() : record.derived()))
      return record.text(clause);
  }
  return "";
}

/// Without what plans have to be cheaper than, and what holds only then.
bool is_about_all_plans(const std::vector<Record>& records) {
  for (const Record& record : records)
    if (record.tag == 'a' && record.values[0] == 13) return false;
  return true;
}

TEST(TimedCertificate, ProvesEachAnswerOnRandomInstances) {
  std::map<Status, std::size_t> answers;
  std::size_t with_polygons = 0, with_obstacles = 0, above_free = 0, with_branches = 0,
              with_ceilings = 0, with_pairs = 0, known = 0;
  for (std::uint32_t seed = 0; seed < scaled(500); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    SCOPED_TRACE(describe(c.instance));
    const SolveOutcome outcome = solve(c.instance, c.options).value();
    ASSERT_FALSE(outcome.internal_error) << outcome.internal_error->to_string();
    ++answers[outcome.status];
    if (!outcome.certificate) {
      ASSERT_EQ(outcome.status, Status::infeasible) << outcome.no_certificate;
      ASSERT_FALSE(outcome.no_certificate.empty());
      continue;
    }
    const Road road = checked(c.instance);
    const Answer answer = ask(road, outcome.certificate->bytes);
    ASSERT_TRUE(answer.is_verified) << answer.reason;
    ASSERT_EQ(answer.verdict.is_infeasible, outcome.status == Status::infeasible);
    ASSERT_EQ(answer.verdict.is_makespan, c.options.objective == Objective::makespan);
    if (answer.verdict.is_infeasible) continue;
    EXPECT_EQ(answer.verdict.bound, outcome.lower_bound);
    EXPECT_EQ(answer.verdict.cost, outcome.cost);
    const auto records = records_of(outcome.certificate->bytes);
    with_obstacles += c.instance.obstacles().empty() ? 0 : 1;
    with_polygons += std::any_of(road.agents.begin(), road.agents.end(),
                                 [](const Road::Agent& agent) { return agent.body.radius == 0; })
                         ? 1
                         : 0;
    for (const Record& record : records) {
      above_free += record.tag == 't' ? 1 : 0;
      with_branches += record.tag == 't' && record.values[2] == 1 ? 1 : 0;
      with_ceilings += record.tag == 'a' && record.values[0] == 13 ? 1 : 0;
      with_pairs += record.tag == 'a' && record.values[0] == 14 ? 1 : 0;
    }
    if (!outcome.plan) continue;
    // Of one that is no cheaper than the known one only what is about all plans has to be true.
    if (is_about_all_plans(records)) {
      ++known;
      EXPECT_EQ(find_false_clause(road, outcome.certificate->bytes, c.instance, *outcome.plan), "");
    }
  }
  EXPECT_GT(answers[Status::optimal], 0U);
  if (scaled(100) < 100) return;
  EXPECT_GT(answers[Status::feasible] + answers[Status::unknown], 0U);
  EXPECT_GT(with_polygons, 0U);
  EXPECT_GT(with_obstacles, 0U);
  EXPECT_GT(above_free, 0U);
  EXPECT_GT(with_branches, 0U);
  EXPECT_GT(with_ceilings, 0U);
  EXPECT_GT(with_pairs, 0U);
  EXPECT_GT(known, 0U);
  RecordProperty("infeasible", static_cast<int>(answers[Status::infeasible]));
}

/// Plans of other objectives, seeds and ways to search: valid, whatever they cost.
std::vector<Plan> other_plans(const Case& c) {
  std::vector<Plan> plans;
  for (const bool is_other : {false, true}) {
    SolveOptions options = c.options;
    options.proof = false;
    options.seed += 7;
    if (is_other)
      options.objective =
          options.objective == Objective::makespan ? Objective::sum_of_costs : Objective::makespan;
    options.gap_percent = is_other ? 0 : 100;
    auto outcome = solve(c.instance, options).value();
    if (outcome.plan) plans.push_back(*std::move(outcome.plan));
  }
  return plans;
}

TEST(TimedCertificate, IsTrueOfOtherPlans) {
  std::size_t looked_at = 0;
  for (std::uint32_t seed = 10'000; seed < 10'000 + scaled(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    const SolveOutcome outcome = solve(c.instance, c.options).value();
    if (!outcome.certificate || !outcome.certificate->claim) continue;
    if (!is_about_all_plans(records_of(outcome.certificate->bytes))) continue;
    const Road road = checked(c.instance);
    for (const Plan& plan : other_plans(c)) {
      ++looked_at;
      EXPECT_EQ(find_false_clause(road, outcome.certificate->bytes, c.instance, plan), "");
    }
  }
  EXPECT_GT(looked_at, 0U);
}

TEST(TimedCertificate, IsTheSameEachTime) {
  for (std::uint32_t seed = 20'000; seed < 20'000 + scaled(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    const SolveOutcome a = solve(c.instance, c.options).value();
    const SolveOutcome b = solve(c.instance, c.options).value();
    ASSERT_EQ(a.certificate.has_value(), b.certificate.has_value());
    EXPECT_EQ(a.statistics.conflicts, b.statistics.conflicts);
    if (a.certificate) {
      EXPECT_EQ(a.certificate->bytes, b.certificate->bytes);
    }
  }
}

/// Components are solved apart without a certificate.
bool is_connected(const Instance& instance) {
  const Roadmap& roadmap = instance.roadmap();
  Grouping grouping(roadmap.num_vertices());
  for (std::size_t e = 0; e < roadmap.num_edges(); ++e)
    grouping.join(roadmap.edge(EdgeId(e)).from.index(), roadmap.edge(EdgeId(e)).to.index());
  for (std::size_t v = 1; v < roadmap.num_vertices(); ++v)
    if (grouping.root(v) != grouping.root(0)) return false;
  return true;
}

TEST(TimedCertificate, LeavesTheSearchAsItIs) {
  std::size_t compared = 0;
  for (std::uint32_t seed = 60'000; seed < 60'000 + scaled(300); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case c = draw(seed);
    if (!is_connected(c.instance)) continue;
    c.options.threads = 1;
    c.options.joint_work = c.options.route_work = 0;
    const SolveOutcome a = solve(c.instance, c.options).value();
    c.options.proof = false;
    const SolveOutcome b = solve(c.instance, c.options).value();
    EXPECT_FALSE(b.certificate);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_EQ(a.lower_bound, b.lower_bound);
    EXPECT_EQ(a.plan, b.plan);
    EXPECT_EQ(a.statistics.conflicts, b.statistics.conflicts);
    EXPECT_EQ(a.statistics.decisions, b.statistics.decisions);
    EXPECT_EQ(a.statistics.clauses, b.statistics.clauses);
    EXPECT_EQ(a.statistics.cores, b.statistics.cores);
    compared += a.statistics.conflicts > 0 ? 1 : 0;
  }
  EXPECT_GT(compared, 0U);
}

// Times and costs of certificates count from the moment at which the instance begins.
TEST(TimedCertificate, IsThatOfTheInstanceBegunAt0) {
  for (std::uint32_t seed = 70'000; seed < 70'000 + scaled(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    std::vector<Agent> agents;
    constexpr Ticks kNow = 1'000'000;
    for (Agent agent : c.instance.agents()) {
      if (agent.release > 0) agent.release += kNow;
      if (agent.deadline) *agent.deadline += kNow;
      agents.push_back(agent);
    }
    std::vector<MovingObstacle> obstacles = c.instance.obstacles();
    for (MovingObstacle& obstacle : obstacles)
      for (MovingObstacle::Stop& stop : obstacle.path) {
        stop.arrive += kNow;
        stop.depart += kNow;
      }
    const Instance later = Instance::make(c.instance.shared_roadmap(), std::move(agents),
                                          c.instance.resolution(), {}, std::move(obstacles), kNow)
                               .value();
    const SolveOutcome a = solve(c.instance, c.options).value();
    const SolveOutcome b = solve(later, c.options).value();
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(a.certificate.has_value(), b.certificate.has_value());
    if (!b.certificate) continue;
    EXPECT_EQ(a.certificate->bytes, b.certificate->bytes);
    const Answer answer = ask(checked(later), b.certificate->bytes);
    EXPECT_TRUE(answer.is_verified) << answer.reason;
  }
}

TEST(TimedCertificate, OfASessionRestsOnNoEarlierAnswer) {
  std::size_t solved = 0;
  for (std::uint32_t seed = 80'000; seed < 80'000 + scaled(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    Session session(c.instance.shared_roadmap(), c.instance.resolution(), c.instance.obstacles());
    std::vector<MemberId> members;
    for (const Agent& agent : c.instance.agents())
      if (auto member = session.add(agent)) members.push_back(member.value());
    Random random(seed);
    for (int round = 0; round < 4 && !members.empty(); ++round) {
      const auto instance = session.instance();
      const auto outcome = session.solve(c.options);
      if (instance && outcome && outcome->certificate) {
        ++solved;
        const Answer answer = ask(checked(*instance), outcome->certificate->bytes);
        EXPECT_TRUE(answer.is_verified) << answer.reason;
        EXPECT_EQ(answer.verdict.bound, outcome->lower_bound);
        EXPECT_EQ(answer.verdict.cost, outcome->cost);
      }
      const MemberId member = members[random.below(members.size())];
      Agent agent = session.agent(member);
      agent.release = Ticks(static_cast<std::int64_t>(random.below(9)));
      if (!agent.under_way) static_cast<void>(session.change(member, agent));
    }
  }
  EXPECT_GT(solved, 0U);
}

TEST(TimedCertificate, ProvesTheBoundThatALimitLeaves) {
  std::size_t below = 0, without_plan = 0;
  for (std::uint32_t seed = 30'000; seed < 30'000 + scaled(30); ++seed) {
    Case c = draw(seed);
    c.options.threads = 1;
    const Road road = checked(c.instance);
    for (std::int64_t looks = 0; looks < 3000; looks += 1 + looks / 8) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", looks " << looks);
      c.options.limits.looks = looks;
      const SolveOutcome outcome = solve(c.instance, c.options).value();
      if (outcome.status == Status::infeasible) break;
      ASSERT_TRUE(outcome.certificate) << outcome.no_certificate;
      const Answer answer = ask(road, outcome.certificate->bytes);
      ASSERT_TRUE(answer.is_verified) << answer.reason;
      EXPECT_EQ(answer.verdict.bound, outcome.lower_bound);
      EXPECT_EQ(answer.verdict.cost, outcome.cost);
      below += outcome.status == Status::optimal ? 0 : 1;
      without_plan += outcome.plan ? 0 : 1;
      if (outcome.status == Status::optimal) break;
    }
  }
  EXPECT_GT(below, 0U);
  EXPECT_GT(without_plan, 0U);
}

TEST(TimedCertificate, DoesNotProveWhatTheUserClaims) {
  int claims = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Case c = draw(seed);
    c.options.limits.conflicts = 0;
    const SolveOutcome plain = solve(c.instance, c.options).value();
    if (plain.status == Status::infeasible) continue;
    c.options.known_lower_bound = plain.lower_bound + 1;
    const auto claimed = solve(c.instance, c.options);
    if (!claimed || !claimed->certificate) continue;  // the claim is refuted
    ++claims;
    EXPECT_LE(*claimed->certificate->claim, plain.lower_bound);
    const Answer answer = ask(checked(c.instance), claimed->certificate->bytes);
    EXPECT_TRUE(answer.is_verified) << answer.reason;
  }
  EXPECT_GT(claims, 0);
}

TEST(TimedCertificate, RefusesWhatThereIsNoRuleFor) {
  RandomOptions asked;
  asked.shapes_percent = asked.no_waiting_percent = 0;  // refused
  SolveOptions options;
  options.proof = true;
  options.limits.conflicts = 100;
  options.limits.looks = 1'000;
  const auto refusal = [&](std::uint32_t seed) {
    const auto outcome = solve(random_instance(seed, asked), options);
    return outcome ? std::string() : outcome.error().message;
  };
  EXPECT_EQ(refusal(1), "");
  asked.goal_sets_percent = 100;
  EXPECT_NE(refusal(1).find("several goals"), std::string::npos);
  asked.goal_sets_percent = 0;
  asked.shapes_percent = 100;
  asked.space_percent = 0;
  EXPECT_NE(refusal(2).find("bodies change"), std::string::npos);
  asked.shapes_percent = 0;
  asked.no_waiting_percent = 100;
  asked.num_vertices = 12;
  EXPECT_NE(refusal(3).find("nobody may wait"), std::string::npos);
  // In the middle of a move of five ticks, two of which lie behind.
  auto roadmap =
      Roadmap::make({{0, 0}, {10, 0}, {4, 0}},
                    {{VertexId(0), VertexId(1), Ticks{5}}, {VertexId(2), VertexId(1), Ticks{3}}},
                    {{VertexId(2), VertexId(0), VertexId(1), 2, 5}});
  ASSERT_TRUE(roadmap.has_value()) << roadmap.error().to_string();
  Agent agent;
  agent.start = VertexId(2);
  agent.goals = VertexId(1);
  const Instance under_way = Instance::make(std::move(roadmap).value(), {agent}).value();
  EXPECT_TRUE(solve(under_way, SolveOptions()).has_value());
  const auto outcome = solve(under_way, options);
  ASSERT_FALSE(outcome.has_value());
  EXPECT_NE(outcome.error().message.find("middle of moves"), std::string::npos);
}

// ---- mutations ----------------------------------------------------------------------------------

TEST(TimedCertificate, CannotBeBrokenToProveTooMuch) {
  std::size_t accepted = 0, tried = 0;
  for (std::uint32_t seed = 40'000; seed < 40'000 + scaled(150); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    const SolveOutcome outcome = solve(c.instance, c.options).value();
    if (outcome.status != Status::optimal) continue;
    const Road road = checked(c.instance);
    const auto records = records_of(outcome.certificate->bytes);
    ASSERT_EQ(bytes_of(records), outcome.certificate->bytes);
    ASSERT_TRUE(ask(road, text_of(records)).is_verified);
    Random random(seed);
    for (int k = 0; k < 150; ++k) {
      std::vector<Record> broken = records;
      for (std::size_t n = random.between(1, 3); n > 0 && !broken.empty(); --n)
        mutate(broken, random);
      const Answer answer = ask(road, bytes_of(broken));
      ++tried;
      if (!answer.is_verified) continue;
      ++accepted;
      ASSERT_FALSE(answer.verdict.is_infeasible);
      const Objective about =
          answer.verdict.is_makespan ? Objective::makespan : Objective::sum_of_costs;
      ASSERT_LE(answer.verdict.bound, cost(*outcome.plan, about)) << text_of(broken);
    }
  }
  EXPECT_LT(accepted, tried);
  EXPECT_GT(accepted, 0U);
}

TEST(TimedCertificate, IsRejectedWithoutWhatItNeeds) {
  std::size_t axioms = 0;
  for (std::uint32_t seed = 50'000; seed < 50'000 + scaled(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    const SolveOutcome outcome = solve(c.instance, c.options).value();
    if (outcome.status != Status::optimal) continue;
    const Road road = checked(c.instance);
    const auto records = records_of(outcome.certificate->bytes);
    for (std::size_t at = 0; at < records.size(); ++at) {
      std::vector<Record> broken = records;
      if (broken[at].tag == 'q' || broken[at].tag == 't') {
        ++broken[at].values[0];
        EXPECT_FALSE(ask(road, bytes_of(broken)).is_verified) << "a larger claim";
      }
      if (broken[at].tag == 't') {
        broken = records;
        broken.insert(broken.begin() + static_cast<std::ptrdiff_t>(at), Record(records[at]));
        EXPECT_FALSE(ask(road, bytes_of(broken)).is_verified) << "a tree that counts twice";
      }
      if (records[at].tag == 'a' && records[at].values[0] != 13) {
        // Without what is true in the plan it excludes a plan.
        quadrille_check::TimedChecker checker(road);
        for (std::size_t k = 0; k < at; ++k) checker.check(records[k]);
        const TimedInterpretation plan(checker.meanings(), c.instance, *outcome.plan);
        Record axiom = records[at];
        const auto first = axiom.values.begin() + 2 + static_cast<std::ptrdiff_t>(axiom.values[1]);
        axiom.values.erase(
            std::remove_if(first, axiom.values.end(), [&](Int lit) { return plan.is_true(lit); }),
            axiom.values.end());
        ++axioms;
        EXPECT_THROW(checker.check(axiom), quadrille_check::Rejected) << axiom.text(0);
      }
    }
    const std::string& whole = outcome.certificate->bytes;
    Random random(seed);
    for (int k = 0; k < 20; ++k) {
      const Answer cut = ask(road, whole.substr(0, random.below(whole.size())));
      EXPECT_FALSE(cut.is_verified && cut.verdict.cost == *outcome.cost);
      std::string flipped = whole;
      flipped[random.below(whole.size())] ^= static_cast<char>(1 << random.below(8));
      const Answer answer = ask(road, flipped);
      EXPECT_TRUE(!answer.is_verified || answer.verdict.bound <= *outcome.cost ||
                  answer.verdict.is_makespan != (c.options.objective == Objective::makespan));
    }
  }
  EXPECT_GT(axioms, 0U);
}

}  // namespace
}  // namespace quadrille::continuous::test
