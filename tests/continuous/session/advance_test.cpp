// SPDX-License-Identifier: MIT
// Sessions while time goes on: whatever has been done of whichever plan, the answer is that of a
// solve of what is left that knows nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "continuous/session/same_answer.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/generator.hpp"
#include "quadrille/continuous/session.hpp"
#include "quadrille/core/random.hpp"
#include "session/history.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

TEST(History, SaysWhereOneIsAndWhatIsLeft) {
  const VertexId a(0), b(1), c(2);
  const Path path{{a, 10, 15}, {b, 25, 25}, {c, 30, 30}};
  const Later waiting = later(path, 12);
  EXPECT_FALSE(waiting.moves || waiting.ends);
  EXPECT_EQ(waiting.rest, (Path{{a, 0, 3}, {b, 13, 13}, {c, 18, 18}}));
  const Later first = later(path, 16);
  EXPECT_TRUE(first.moves && first.is_first);
  EXPECT_EQ(first.begun, Ticks(1));
  EXPECT_EQ(first.rest, (Path{{a, 0, 0}, {b, 9, 9}, {c, 14, 14}}));
  const Later passing = later(path, 25);
  EXPECT_FALSE(passing.moves);
  EXPECT_EQ(passing.rest, (Path{{b, 0, 0}, {c, 5, 5}}));
  EXPECT_TRUE(later(path, 29).moves);
  EXPECT_FALSE(later(path, 29).is_first);
  const Later done = later(path, 99);
  EXPECT_TRUE(done.ends && !done.moves);
  EXPECT_EQ(done.rest, (Path{{c, 0, 0}}));
  EXPECT_TRUE(later(path, 15).is_where(later({{a, 10, 15}, {c, 99, 99}}, 15)));
  EXPECT_FALSE(first.is_where(later({{a, 10, 14}, {b, 24, 24}}, 16)));
  EXPECT_FALSE(first.is_where(waiting));
}

struct Moments {
  int optimal = 0, moments = 0, late = 0, on_the_way = 0;
};

/// A fleet at work.
class Work {
 public:
  Work(std::uint32_t seed, const RandomOptions& shape, const SolveOptions& options)
      : first_(random_instance(seed, shape)),
        options_(options),
        random_(seed),
        session_(first_.shared_roadmap(), first_.resolution(), first_.obstacles()) {
    for (const Agent& agent : first_.agents()) static_cast<void>(session_.add(agent).value());
  }

  void go_on(int moments, Tally& tally, Moments& history) {
    for (int k = 0; k < moments; ++k) {
      SCOPED_TRACE("moment " + std::to_string(k));
      change();
      const auto instance = session_.instance();
      SolveOptions audited = options_;
      audited.debug.audit = k % 2 == 0;
      const auto warm = session_.solve(audited);
      ASSERT_EQ(warm.has_value(), instance.has_value());
      if (!instance) {
        ++tally.refused;
        send_all();
        continue;
      }
      SCOPED_TRACE(describe(*instance));
      const auto cold = solve(*instance, options_);
      expect_equal(*instance, options_, *warm, *cold, tally);
      if (testing::Test::HasFatalFailure()) return;
      if (!warm->plan) {
        send_all();
        continue;
      }
      advance(*instance, *warm->plan, history);
      if (testing::Test::HasFatalFailure()) return;
    }
  }

 private:
  void advance(const Instance& instance, Plan plan, Moments& history) {
    // What is done need not be what is best: everybody may be late, or follow another plan.
    const std::size_t kind = draw(4);
    if (kind == 0) {
      Plan late = plan;
      const auto by = static_cast<std::int64_t>(1 + draw(20));
      for (Path& path : late.paths)
        for (Stop& stop : path) {
          if (stop.arrive > instance.now() || &stop != &path.front()) stop.arrive += Ticks(by);
          stop.depart += Ticks(by);
        }
      if (verify(instance, late).valid()) {
        plan = late;
        ++history.late;
      }
    } else if (kind == 1) {
      SolveOptions other = options_;
      other.gap_percent = 100;
      other.seed = static_cast<std::uint32_t>(draw(1000));
      if (const auto found = solve(instance, other); found && found->plan) plan = *found->plan;
    }
    const std::int64_t length = cost(plan, Objective::makespan);
    const Ticks now = instance.now() +
                      Ticks(static_cast<std::int64_t>(draw(static_cast<std::size_t>(length) + 3)));
    const auto error = session_.advance_to(now, plan);
    ASSERT_FALSE(error) << error->message;
    ASSERT_EQ(session_.now(), now);
    ++history.moments;
    for (const MemberId member : session_.members())
      history.on_the_way += session_.agent(member).under_way ? 1 : 0;
  }

  void change() {
    for (const MemberId member : session_.members()) {
      if (draw(100) < 10) take_back(member);
      const Agent& agent = session_.agent(member);
      const bool is_there = !agent.under_way && agent.goals.contains(agent.start);
      if (draw(100) < (is_there ? 50U : 8U)) send(member);
    }
    if (draw(100) < 15) {
      const EdgeId edge(draw(first_.roadmap().num_edges()));
      const auto error = session_.is_closed(edge) ? session_.open(edge) : session_.close(edge);
      ASSERT_FALSE(error);
    }
    if (draw(100) < 5 && session_.members().size() > 2) {
      const std::vector<MemberId> members = session_.members();
      ASSERT_FALSE(session_.remove(members[draw(members.size())]));
    }
  }
  /// Something else, and the next time what it was before, as if it had not moved meanwhile.
  void take_back(MemberId member) {
    const Agent& agent = session_.agent(member);
    if (const auto at = earlier_.find(member); at != earlier_.end()) {
      ASSERT_FALSE(session_.change(member, at->second));
      earlier_.erase(at);
    } else if (!agent.under_way) {
      earlier_.emplace(member, agent);
      send(member);
    }
  }
  void send_all() {
    for (const MemberId member : session_.members()) send(member);
    for (std::size_t e = 0; e < first_.roadmap().num_edges(); ++e)
      if (session_.is_closed(EdgeId(e))) {
        ASSERT_FALSE(session_.open(EdgeId(e)));
      }
  }
  /// Nobody else is sent there, if one is soon found. A deadline is for one task.
  void send(MemberId member) {
    VertexId goal;
    for (int tries = 0; tries < 10; ++tries) {
      goal = VertexId(draw(first_.roadmap().num_vertices()));
      const std::vector<MemberId> members = session_.members();
      if (std::none_of(members.begin(), members.end(),
                       [&](MemberId m) { return session_.agent(m).goals.contains(goal); }))
        break;
    }
    ASSERT_FALSE(session_.assign(member, goal));
  }
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_.below(count)); }

  const Instance first_;
  const SolveOptions options_;
  Random random_;
  Session session_;
  std::map<MemberId, Agent> earlier_;
};

RandomOptions roads(std::uint32_t seed) {
  RandomOptions options;
  options.num_vertices = seed % 2 == 0 ? 8 : 10;
  options.num_agents = seed % 2 == 0 ? 3 : 4;
  options.size = seed % 2 == 0 ? options.size : 60;
  options.edge_percent = 65;
  options.max_radius = 5;
  return options;
}

TEST(Session, LivesWhileTimeGoesOn) {
  Tally tally;
  Moments history;
  const std::size_t count = std::max<std::size_t>(support::scaled(100), 12);
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    SolveOptions options;
    options.objective = seed % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 5 == 0 ? System::smt_cbs : System::dpll;
    options.threads = seed % 7 == 0 ? 2 : 1;
    // Mostly by clauses, which are what lives on.
    if (seed % 4 != 0) options.joint_work = options.route_work = 0;
    options.limits.conflicts = 200;
    options.limits.looks = 2000;
    Work(seed, roads(seed), options).go_on(15, tally, history);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(3 * tally.optimal, tally.open);
  EXPECT_GT(history.on_the_way, history.moments / 4);
  EXPECT_GT(history.late, 0);
  RecordProperty("optimal", tally.optimal);
  RecordProperty("open", tally.open);
  RecordProperty("moments", history.moments);
  RecordProperty("without_search", tally.without_search);
  RecordProperty("from_lemmas", tally.from_lemmas);
}

// Nothing but time has passed: what was proved is the proof.
TEST(Session, WhatIsLeftOfAnOptimumIsOne) {
  std::int64_t num_warm = 0, num_cold = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RandomInstanceOptions shape;
    shape.num_agents = 8;
    const Instance instance = continuous::random_instance(shape, seed).value();
    Session session(instance.shared_roadmap());
    for (const Agent& agent : instance.agents()) static_cast<void>(session.add(agent).value());
    const SolveOutcome first = session.solve({}).value();
    ASSERT_EQ(first.status, Status::optimal);
    const Ticks soon = as_ticks(cost(*first.plan, Objective::makespan) / 20);
    ASSERT_FALSE(session.advance_to(soon, *first.plan));
    const SolveOutcome warm = session.solve({}).value();
    const SolveOutcome cold = solve(session.instance().value(), {}).value();
    EXPECT_EQ(warm.status, Status::optimal);
    EXPECT_EQ(warm.cost, cold.cost) << seed;
    num_warm += warm.statistics.sat_calls;
    num_cold += cold.statistics.sat_calls;
  }
  EXPECT_LT(2 * num_warm, num_cold);
}

/// From 0 to 2 straight by way of 1, or by way of 5, which is a little longer, or of 3, which is
/// much longer. 4 is beside 1.
class Ways : public ::testing::Test {
 protected:
  Ways()
      : roads_(roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 3000}, {1000, -1000}, {1000, 500}},
                       {{0, 1}, {1, 2}, {0, 3}, {3, 2}, {1, 4}, {0, 5}, {5, 2}})),
        session_(roads_),
        passer_(session_.add(agent(0, 2, 100)).value()),
        resident_(session_.add(agent(1, 1, 100)).value()) {
    for (std::size_t e = 0; e < roads_->num_edges(); ++e)
      if (roads_->edge(EdgeId(e)).from == VertexId(0) && roads_->edge(EdgeId(e)).to == VertexId(5))
        by_five_ = EdgeId(e);
  }
  /// As a solve that knows nothing says, too.
  SolveOutcome solved() {
    const auto warm = session_.solve({}), cold = solve(session_.instance().value(), {});
    EXPECT_EQ(warm->status, Status::optimal);
    EXPECT_EQ(warm->cost, cold->cost);
    return warm.value();
  }
  const std::shared_ptr<const Roadmap> roads_;
  Session session_;
  const MemberId passer_, resident_;
  EdgeId by_five_;
};

// A bound of two members, one of whom has had something else to do meanwhile.
TEST_F(Ways, TasksOfEarlierTimesAreOthers) {
  EXPECT_FALSE(session_.close(by_five_));
  EXPECT_EQ(*solved().cost, 4000);  // it steps aside, and comes back
  EXPECT_FALSE(session_.assign(resident_, VertexId(4)));
  const SolveOutcome outcome = solved();
  EXPECT_EQ(*outcome.cost, 3000);
  EXPECT_FALSE(session_.advance_to(1500, *outcome.plan));
  EXPECT_FALSE(session_.change(resident_, agent(1, 1, 100)));
  EXPECT_EQ(*solved().cost, 500);
}

// A bound that was proved while an edge was closed, which is closed again after it was used.
TEST_F(Ways, WhatWasDoneOnARoadThatWasClosedIsNoBeginning) {
  Agent late = agent(1, 4, 100);
  late.release = 5000;
  EXPECT_FALSE(session_.change(resident_, late));
  EXPECT_FALSE(session_.close(by_five_));
  EXPECT_GT(*solved().cost, 12'000);
  EXPECT_FALSE(session_.open(by_five_));
  const SolveOutcome outcome = solved();
  EXPECT_LT(*outcome.cost, 8300);
  EXPECT_FALSE(session_.advance_to(1500, *outcome.plan));
  EXPECT_FALSE(session_.close(by_five_));
  EXPECT_LT(*solved().cost, 5300);
}

TEST(Session, WhoHasArrivedAndLeavesIsGone) {
  const auto roads = roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}});
  Session session(roads);
  Agent leaver = agent(0, 1, 100);
  leaver.leaves = true;
  const MemberId a = session.add(leaver).value(), b = session.add(agent(2, 1, 100)).value();
  const SolveOutcome outcome = session.solve({}).value();
  ASSERT_TRUE(outcome.plan);
  const Ticks end = outcome.plan->paths[AgentId(0)].back().arrive;
  EXPECT_FALSE(session.advance_to(end - 1, *outcome.plan));
  EXPECT_TRUE(session.agent(a).under_way);
  const SolveOutcome rest = session.solve({}).value();
  EXPECT_EQ(*rest.cost, *outcome.cost - 2 * as_cost(end - 1));
  EXPECT_FALSE(session.advance_to(end, *rest.plan));
  EXPECT_EQ(session.members(), std::vector<MemberId>{b});
  EXPECT_EQ(session.now(), end);
}

TEST(Session, RefusesWhatCannotHaveBeenDone) {
  const auto roads = roadmap({{0, 0}, {1000, 0}, {2000, 0}}, {{0, 1}, {1, 2}});
  Session session(roads, {}, {}, 50);
  const MemberId a = session.add(agent(0, 2, 100)).value();
  const SolveOutcome outcome = session.solve({}).value();
  EXPECT_EQ(session.advance_to(49, *outcome.plan)->message, "time goes back from 50 to 49");
  Plan wrong = *outcome.plan;
  wrong.paths[AgentId(0)].pop_back();
  EXPECT_EQ(session.advance_to(60, wrong)->code, ErrorCode::invalid_plan);
  EXPECT_EQ(session.now(), Ticks(50));
  EXPECT_EQ(session.agent(a).start, VertexId(0));
  EXPECT_EQ(session.assign(a, VertexId(9))->message, "there is no vertex 9");
  EXPECT_EQ(session.assign(MemberId(7), VertexId(1))->message, "there is no member 7");
}

}  // namespace
}  // namespace quadrille::continuous::test
