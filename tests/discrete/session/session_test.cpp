// SPDX-License-Identifier: MIT
//
// Sessions on grids and graphs: whatever has changed, and whatever has been done of whichever plan,
// the answer is that of a solve that knows nothing, and kept bounds are bounds.
#include "quadrille/discrete/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/discrete/verify.hpp"
#include "session/history.hpp"
#include "support/environment.hpp"
#include "support/generators.hpp"
#include "support/random.hpp"

namespace quadrille::discrete::support {
namespace {

TEST(History, SaysWhereOneIsAndWhatIsLeft) {
  const VertexId a(0), b(1), c(2);
  const Path path{a, b, b, c, c};
  EXPECT_EQ(later(path, 0).rest, path);
  EXPECT_EQ(later(path, 2).at, b);
  EXPECT_FALSE(later(path, 2).ends);
  EXPECT_EQ(later(path, 2).rest, (Path{b, c, c}));
  EXPECT_TRUE(later(path, 3).ends);
  EXPECT_EQ(later(path, 99).rest, (Path{c}));
  Agent agent{a, c};
  agent.waypoints = {a, b, c, a};
  EXPECT_EQ(rest_of(agent, path, 0).waypoints, (std::vector<VertexId>{b, c, a}));
  EXPECT_EQ(rest_of(agent, path, 1).waypoints, (std::vector<VertexId>{c, a}));
  EXPECT_EQ(rest_of(agent, path, 2).start, b);
  EXPECT_EQ(rest_of(agent, path, 9).waypoints, (std::vector<VertexId>{a}));
}

struct Tally {
  int optimal = 0, infeasible = 0, open = 0, refused = 0;
  int moments = 0, other_plans = 0, bounds = 0, raised = 0, without_search = 0;
};

/// A fleet at work.
class Work {
 public:
  Work(std::uint64_t seed, bool has_rules, Objective objective)
      : random_(seed), has_rules_(has_rules) {
    options_.objective = objective;
    options_.seed = static_cast<std::uint32_t>(seed);
    options_.limits.conflicts = 2'000;
    options_.limits.looks =
        20'000;  // under rules, where there is no plan, there may be no conflicts
    GridShape shape;
    shape.min_side = 3;
    shape.max_side = 6;
    shape.max_obstacles_percent = 25;
    shape.max_agents = 5;
    const Instance first = random_grid(random_, shape);
    graph_ = first.shared_graph();
    Rules rules;
    if (has_rules && random_.percent(30)) rules.robust = 1;
    session_ = std::make_unique<Session>(graph_, static_cast<Timestep>(random_.below(3)), rules);
    is_robust_ = rules.robust > 0;
    for (const Agent& agent : first.agents()) static_cast<void>(session_->add(agent).value());
  }

  void go_on(int rounds, Tally& tally) {
    for (int k = 0; k < rounds; ++k) {
      SCOPED_TRACE("round " + std::to_string(k));
      change();
      const auto instance = session_->instance();
      const auto warm = session_->solve(options_);
      ASSERT_EQ(warm.has_value(), instance.has_value()) << (warm ? "" : warm.error().message);
      if (!instance) {
        ++tally.refused;
        spread();
        continue;
      }
      audit(*instance, tally);
      SolveOptions told = options_;
      told.explain = instance->is_plain() && options_.objective == Objective::sum_of_costs;
      const auto cold = solve(*instance, told);
      compare(*instance, *warm, *cold, tally);
      if (testing::Test::HasFatalFailure()) return;
      kept_.add(situation(), options_.objective, *cold);
      if (!warm->plan)
        spread();
      else if (random_.percent(60))
        advance(*instance, *warm->plan, tally);
      if (testing::Test::HasFatalFailure()) return;
    }
  }

 private:
  [[nodiscard]] VertexId vertex() { return VertexId(random_.below(graph_->num_vertices())); }

  [[nodiscard]] Situation situation() const {
    Situation now;
    now.begin = session_->now();
    for (const MemberId member : session_->members())
      now.tasks.emplace(member, session_->agent(member));
    for (const auto& place : places_)
      if (session_->is_closed(place.first, place.second)) now.closed.insert(place);
    return now;
  }

  /// Each group is put to a solve of its own.
  void audit(const Instance& instance, Tally& tally) {
    for (const auto& group : kept_.bounds(situation(), options_.objective)) {
      std::vector<Agent> alone;
      for (const AgentId i : group.agents) alone.push_back(instance.agents()[i]);
      SolveOptions asked;
      asked.objective = options_.objective;
      asked.limits = options_.limits;
      const auto outcome = solve(instance.with_agents(std::move(alone)).value(), asked);
      if (outcome->cost) {
        ASSERT_LE(group.cost, *outcome->cost);
      }
      ++tally.bounds;
    }
  }

  void compare(const Instance& instance, const SolveOutcome& warm, const SolveOutcome& cold,
               Tally& tally) {
    ASSERT_FALSE(warm.internal_error) << warm.internal_error->message;
    ASSERT_FALSE(warm.rests_on_known_bound);
    if (warm.plan) {
      ASSERT_TRUE(verify(instance, *warm.plan).valid());
      ASSERT_EQ(warm.plan->cost(options_.objective), *warm.cost);
    }
    if (cold.cost) {
      ASSERT_LE(warm.lower_bound, *cold.cost);
    }
    const auto is_proof = [](Status s) { return s == Status::optimal || s == Status::infeasible; };
    if (!is_proof(warm.status) || !is_proof(cold.status)) {
      ++tally.open;
      return;
    }
    ASSERT_EQ(warm.status, cold.status) << warm.explanation << cold.explanation;
    ASSERT_EQ(warm.cost, cold.cost);
    ++(warm.status == Status::optimal ? tally.optimal : tally.infeasible);
    if (warm.statistics.sat_calls < cold.statistics.sat_calls) ++tally.without_search;
    if (warm.cost && cold.attribution && *warm.cost > cold.attribution->free_bound) ++tally.raised;
  }

  void advance(const Instance& instance, Plan plan, Tally& tally) {
    if (random_.percent(30)) {  // what is done need not be what is best
      SolveOptions other = options_;
      other.gap_percent = 100;
      other.seed = static_cast<std::uint32_t>(random_.below(1000));
      if (const auto found = solve(instance, other); found && found->plan) plan = *found->plan;
      ++tally.other_plans;
    } else if (random_.percent(30)) {  // everybody is late
      for (Path& path : plan.paths) path.insert(path.begin(), 2, path.front());
      if (!verify(instance, plan).valid()) return;
      ++tally.other_plans;
    }
    const auto length = static_cast<std::size_t>(plan.cost(Objective::makespan));
    const Timestep now = instance.now() + static_cast<Timestep>(random_.below(length + 3));
    History history{situation(), {}, {}};
    std::size_t index = 0;
    for (const auto& [member, agent] : history.before.tasks)
      history.members.emplace(member, later(plan.paths[AgentId(index++)], now - instance.now()));
    const auto error = session_->advance_to(now, plan);
    ASSERT_FALSE(error) << error->message;
    ASSERT_EQ(session_->now(), now);
    history.after = situation();
    if (is_robust_)
      kept_.clear();
    else if (now > instance.now())
      kept_.advance(history);
    ++tally.moments;
  }

  void change() {
    for (const MemberId member : session_->members()) {
      const Agent& agent = session_->agent(member);
      const bool is_there = agent.goals.contains(agent.start);
      if (!random_.percent(is_there ? 40 : 8)) continue;
      if (random_.percent(50)) {
        ASSERT_FALSE(session_->assign(member, vertex()));
      } else {
        Agent other = agent;
        std::vector<VertexId> goals{vertex()};
        if (const VertexId more = vertex(); more != goals[0]) goals.push_back(more);
        other.goals = Goals(goals);
        if (has_rules_) add_rules(other);
        ASSERT_FALSE(session_->change(member, other));
      }
    }
    if (has_rules_ && random_.percent(25)) toggle();
    const auto members = session_->members();
    if (random_.percent(8) && members.size() > 2) {
      ASSERT_FALSE(session_->remove(members[random_.below(members.size())]));
    } else if (random_.percent(8) && members.size() < 6) {
      static_cast<void>(session_->add({vertex(), vertex()}).value());
    }
  }

  void add_rules(Agent& agent) {
    const Timestep now = session_->now();
    agent.leaves = random_.percent(30);
    if (random_.percent(20)) agent.release = now + static_cast<Timestep>(random_.below(4));
    agent.deadline.reset();
    if (random_.percent(15)) agent.deadline = now + 5 + static_cast<Timestep>(random_.below(12));
    if (random_.percent(20)) agent.waypoints = {vertex()};
  }

  /// Closes or opens a place.
  void toggle() {
    const VertexId v = vertex();
    std::optional<VertexId> to;
    const auto next = graph_->neighbours(v);
    if (!next.empty() && random_.percent(70)) to = next[random_.below(next.size())];
    const auto place = to && *to < v ? AnswerDomain::Closed{*to, v} : AnswerDomain::Closed{v, to};
    places_.push_back(place);
    const auto error = session_->is_closed(v, to) ? session_->open(v, to) : session_->close(v, to);
    ASSERT_FALSE(error) << error->message;
  }

  /// Everybody begins anew, at different places.
  void spread() {
    std::vector<VertexId> all;
    for (std::size_t v = 0; v < graph_->num_vertices(); ++v) all.emplace_back(v);
    for (std::size_t k = all.size(); k > 1; --k) std::swap(all[k - 1], all[random_.below(k)]);
    for (const auto& [v, to] : places_)
      if (session_->is_closed(v, to)) static_cast<void>(session_->open(v, to));
    std::size_t next = 0;
    for (const MemberId member : session_->members()) {
      if (next + 1 >= all.size()) {
        ASSERT_FALSE(session_->remove(member));
        continue;
      }
      ASSERT_FALSE(session_->change(member, {all[next], all[next + 1]}));
      ++next;
    }
  }

  quadrille::support::Random random_;
  const bool has_rules_;
  bool is_robust_ = false;
  SolveOptions options_;
  std::shared_ptr<const Graph> graph_;
  std::unique_ptr<Session> session_;
  std::vector<AnswerDomain::Closed> places_;  // that were ever closed
  BoundCache kept_;                           // of what solves that know nothing have proved
};

void work(std::uint64_t first, std::size_t count, bool has_rules, Objective objective,
          Tally& tally) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Work(seed, has_rules, objective).go_on(12, tally);
    if (testing::Test::HasFatalFailure()) return;
  }
  testing::Test::RecordProperty("optimal", tally.optimal);
  testing::Test::RecordProperty("infeasible", tally.infeasible);
  testing::Test::RecordProperty("open", tally.open);
  testing::Test::RecordProperty("refused", tally.refused);
  testing::Test::RecordProperty("moments", tally.moments);
  testing::Test::RecordProperty("bounds", tally.bounds);
  testing::Test::RecordProperty("raised", tally.raised);
  testing::Test::RecordProperty("without_search", tally.without_search);
  if (count < 100) return;  // scaled down, for slow builds: too few to count on chance
  const int all = static_cast<int>(count);
  EXPECT_GE(tally.optimal, 3 * all);
  EXPECT_GE(tally.moments, all);
  EXPECT_GE(tally.bounds, all);
  EXPECT_GE(tally.without_search, all / 10);
  EXPECT_LE(tally.open, tally.optimal / 20);
}

TEST(GridSession, AnswersLikeASolveThatKnowsNothing) {
  Tally tally;
  work(1'000, quadrille::support::scaled(200), false, Objective::sum_of_costs, tally);
}

TEST(GridSession, AnswersForTheMakespan) {
  Tally tally;
  work(2'000, quadrille::support::scaled(200), false, Objective::makespan, tally);
}

TEST(GridSession, AnswersUnderRules) {
  Tally tally;
  work(3'000, quadrille::support::scaled(100), true, Objective::sum_of_costs, tally);
}

/// A row of five cells with a bay beside the middle.
std::shared_ptr<const Graph> bay() {
  return std::make_shared<const Graph>(
      Graph::grid(5, 2, {true, true, true, true, true, false, false, true, false, false}));
}

TEST(GridSession, TakesUpWhatIsLeft) {
  Session session(bay());
  const MemberId a = session.add({VertexId(0), VertexId(4)}).value();
  const MemberId b = session.add({VertexId(4), VertexId(0)}).value();
  const SolveOptions options;
  const auto first = session.solve(options).value();
  EXPECT_EQ(first.status, Status::optimal);
  EXPECT_FALSE(first.attribution);
  const auto again = session.solve(options).value();
  EXPECT_EQ(again.cost, first.cost);
  EXPECT_EQ(again.statistics.sat_calls, 0);
  EXPECT_FALSE(again.rests_on_known_bound);
  ASSERT_FALSE(session.advance_to(2, *first.plan));
  EXPECT_EQ(session.agent(a).start, position(first.plan->paths[AgentId(0)], 2));
  EXPECT_EQ(session.instance()->now(), 2);
  const auto rest = session.solve(options).value();
  EXPECT_EQ(rest.cost, *first.cost - 4);
  EXPECT_EQ(rest.statistics.sat_calls, 0);
  EXPECT_EQ(rest.plan->now, 2);
  ASSERT_FALSE(session.assign(b, VertexId(5)));
  const auto other = session.solve(options).value(),
             fresh = solve(*session.instance(), options).value();
  EXPECT_EQ(other.cost, fresh.cost);
  ASSERT_FALSE(session.assign(b, VertexId(4)));  // where the other one stays
  EXPECT_EQ(session.solve(options).error().code, ErrorCode::invalid_instance);
}

TEST(GridSession, RefusesWhatMakesNoSense) {
  Session session(bay());
  EXPECT_EQ(session.add({VertexId(9), VertexId(0)}).error().message, "there is no vertex 9");
  EXPECT_EQ(session.add({VertexId(0), Goals(std::vector<VertexId>())}).error().message,
            "a member has no goal");
  EXPECT_EQ(session.remove(MemberId(3))->message, "there is no member 3");
  const MemberId a = session.add({VertexId(0), VertexId(4)}).value();
  EXPECT_EQ(session.change(a, {VertexId(0), VertexId(7)})->message, "there is no vertex 7");
  EXPECT_EQ(session.agent(a).goal(), VertexId(4));
  EXPECT_EQ(session.close(VertexId(0), VertexId(4))->message, "there is no such place to close");
  EXPECT_EQ(session.open(VertexId(1), VertexId(0))->message,
            "the edge between (1, 0) and (0, 0) is not closed");
  ASSERT_FALSE(session.close(VertexId(1), VertexId(0)));
  EXPECT_TRUE(session.is_closed(VertexId(0), VertexId(1)));
  EXPECT_EQ(session.close(VertexId(0), VertexId(1))->message,
            "the edge between (0, 0) and (1, 0) is closed already");
  EXPECT_EQ(session.solve({}).value().status, Status::infeasible);
  ASSERT_FALSE(session.open(VertexId(0), VertexId(1)));
  const Plan plan = *session.solve({}).value().plan;
  ASSERT_FALSE(session.advance_to(1, plan));
  EXPECT_EQ(session.advance_to(0, plan)->message, "time goes back from 1 to 0");
  EXPECT_EQ(session.advance_to(2, plan)->code, ErrorCode::invalid_plan);
}

}  // namespace
}  // namespace quadrille::discrete::support
