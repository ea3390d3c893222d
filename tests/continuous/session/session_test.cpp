// SPDX-License-Identifier: MIT
// Sessions: after every change the answer is that of a solve that knows nothing, and a change that
// makes no sense is refused.
#include "quadrille/continuous/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "continuous/session/same_answer.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/roads.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/random.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

/// A session that is changed at random.
class RandomSession {
 public:
  RandomSession(std::uint32_t seed, const RandomOptions& options)
      : random_(seed), session_(begin(seed, options)) {}

  Session& session() { return session_; }
  [[nodiscard]] const Roadmap& roadmap() const { return *roadmap_; }

  void edit() {
    std::optional<Error> error;
    const std::vector<MemberId> members = session_.members();
    const std::size_t kind = members.size() < 2 ? 0 : draw(8);
    if (kind == 0) {
      if (members.size() < 5) static_cast<void>(session_.add(drawn_agent()).value());
    } else if (kind == 1) {
      error = session_.remove(some(members));
    } else if (kind == 2) {
      // One after the other: compilers differ in which argument they draw first.
      const MemberId member = some(members);
      error = session_.change(member, drawn_agent());
    } else if (kind == 3) {
      const MemberId member = some(members);
      Agent agent = session_.agent(member);
      agent.under_way = false;
      agent.goals = other_goals(agent);
      error = session_.change(member, agent);
    } else if (kind == 4) {
      error = put_under_way(some(members));
    } else {
      // Few are closed at a time.
      const EdgeId edge(draw(roadmap_->num_edges()));
      if (closed_.size() > draw(4)) {
        const std::size_t which = draw(closed_.size());
        error = session_.open(closed_[which]);
        closed_.erase(closed_.begin() + static_cast<std::ptrdiff_t>(which));
      } else if (!session_.is_closed(edge)) {
        error = session_.close(edge);
        closed_.push_back(edge);
      }
    }
    ASSERT_FALSE(error) << error->message;
  }

 private:
  Session begin(std::uint32_t seed, const RandomOptions& options) {
    const Instance first = random_instance(seed, options);
    roadmap_ = first.shared_roadmap();
    Session session(roadmap_, first.resolution(), first.obstacles());
    for (const Agent& agent : first.agents()) {
      agents_.push_back(agent);
      static_cast<void>(session.add(agent).value());
    }
    return session;
  }
  Agent drawn_agent() {
    Agent agent = agents_[draw(agents_.size())];
    agent.start = free_vertex(start_of);
    agent.goals = other_goals(agent);
    return agent;
  }
  Goals other_goals(const Agent& agent) {
    if (agent.goals.is_single()) return free_vertex(goal_of);
    // One stays, one is new.
    return Goals({agent.goals.vertices().front(), free_vertex(goal_of)});
  }
  static VertexId start_of(const Agent& agent) { return agent.start; }
  static VertexId goal_of(const Agent& agent) { return agent.goals.vertices().front(); }
  /// Nobody's start (goal), if one is soon found, and where agents may wait.
  VertexId free_vertex(VertexId (*place_of)(const Agent&)) {
    VertexId v;
    for (int k = 0; k < 10; ++k) {
      do v = VertexId(draw(roadmap_->num_vertices()));
      while (!roadmap_->may_wait(v));
      const std::vector<MemberId> members = session_.members();
      if (std::none_of(members.begin(), members.end(),
                       [&](MemberId m) { return place_of(session_.agent(m)) == v; }))
        break;
    }
    return v;
  }
  std::optional<Error> put_under_way(MemberId member) {
    for (int k = 0; k < 10; ++k) {
      const EdgeId edge(draw(roadmap_->num_edges()));
      const auto error = session_.put_under_way(member, edge, Ticks(0));
      if (error) continue;
      const auto behind = static_cast<std::int64_t>(draw(8));
      // Too late on a short edge is refused, and changes nothing.
      static_cast<void>(session_.put_under_way(member, edge, Ticks(behind)));
      return std::nullopt;
    }
    return std::nullopt;
  }
  MemberId some(const std::vector<MemberId>& members) { return members[draw(members.size())]; }
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_.below(count)); }

  Random random_;
  std::shared_ptr<const Roadmap> roadmap_;
  std::vector<Agent> agents_;
  std::vector<EdgeId> closed_;
  Session session_;
};

RandomOptions small_roadmap(std::uint32_t seed) {
  RandomOptions options;
  options.num_vertices = 7 + seed % 3;
  options.num_agents = 3;
  options.edge_percent = 65;
  options.max_radius = 5;
  options.deadline_percent = 5;
  return options;
}

/// Where clauses have something to do.
RandomOptions crowded_roadmap() {
  RandomOptions options;
  options.num_vertices = 10;
  options.num_agents = 4;
  options.size = 60;
  options.edge_percent = 60;
  options.max_radius = 5;
  options.deadline_percent = 5;
  return options;
}

/// Changes and solves, again and again.
void run_session(RandomSession random, const SolveOptions& options, int num_edits, Tally& tally) {
  for (int k = 0; k < num_edits; ++k) {
    random.edit();
    if (testing::Test::HasFatalFailure()) return;
    const auto instance = random.session().instance();
    SolveOptions audited = options;
    // Every lemma is derived again, and every core: those of earlier solves, too.
    audited.debug.audit = k % 2 == 0;
    const auto warm = random.session().solve(audited);
    ASSERT_EQ(warm.has_value(), instance.has_value());
    if (!instance) {
      ASSERT_EQ(warm.error().message, instance.error().message);
      ++tally.refused;
      continue;
    }
    const auto cold = solve(*instance, options);
    SCOPED_TRACE("edit " + std::to_string(k) + "\n" + describe(*instance));
    expect_equal(*instance, options, *warm, *cold, tally);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Session, AnswersAreThoseOfSolvesThatKnowNothing) {
  constexpr int kEdits = 25;
  Tally tally;
  for (std::uint32_t seed = 1; seed <= support::scaled(80); ++seed) {
    SCOPED_TRACE(seed);
    SolveOptions options;
    options.objective = seed % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 5 == 0 ? System::smt_cbs : System::dpll;
    options.threads = seed % 7 == 0 ? 2 : 1;
    // Mostly by clauses, whose bounds name few agents.
    if (seed % 4 != 0) options.joint_work = options.route_work = 0;
    options.limits.conflicts = 300;
    options.limits.looks = 1000;
    run_session(RandomSession(seed, small_roadmap(seed)), options, kEdits, tally);
    if (HasFatalFailure()) return;
  }
  // Where no plan exists, which nothing proves, the limits decide.
  EXPECT_GT(3 * tally.optimal, tally.open);
  EXPECT_GT(tally.without_search, 0);
  RecordProperty("optimal", tally.optimal);
  RecordProperty("infeasible", tally.infeasible);
  RecordProperty("refused", tally.refused);
  RecordProperty("open", tally.open);
  RecordProperty("without_search", tally.without_search);
}

// Lemmas outlive changes, and all that do are derived again.
TEST(Session, LemmasLiveOn) {
  Tally tally;
  // Fewer say nothing: of the first one's situations most have no plan.
  const std::size_t count = std::max<std::size_t>(support::scaled(8), 3);
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    SolveOptions options;
    options.objective = seed % 5 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 4 == 0 ? System::smt_cbs : System::dpll;
    options.joint_work = options.route_work = 0;
    options.limits.conflicts = 100;
    options.limits.looks = 6000;
    run_session(RandomSession(1000 + seed, crowded_roadmap()), options, 20, tally);
    if (HasFatalFailure()) return;
  }
  // Where no plan exists, which nothing proves, the limits decide.
  EXPECT_GT(3 * tally.optimal, tally.open);
  EXPECT_GT(tally.from_lemmas, 0);
  RecordProperty("optimal", tally.optimal);
  RecordProperty("open", tally.open);
  RecordProperty("from_lemmas", tally.from_lemmas);
}

// Where agents may end at several goals, lemmas say which ones, and pass on as well.
TEST(Session, GoalSetsLiveOn) {
  Tally tally;
  // Of fewer, lemmas from before may decide none.
  const std::size_t count = std::max<std::size_t>(support::scaled(12), 6);
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomOptions roadmap = crowded_roadmap();
    roadmap.goal_sets_percent = 60;
    SolveOptions options;
    options.objective = seed % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.system = seed % 5 == 0 ? System::smt_cbs : System::dpll;
    // Mostly by clauses, which are what lives on.
    if (seed % 4 != 0) options.joint_work = options.route_work = 0;
    options.limits.conflicts = 100;
    options.limits.looks = 6000;
    run_session(RandomSession(3000 + seed, roadmap), options, 20, tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(3 * tally.optimal, tally.open);
  EXPECT_GT(tally.from_lemmas, 0);
  RecordProperty("optimal", tally.optimal);
  RecordProperty("open", tally.open);
  RecordProperty("from_lemmas", tally.from_lemmas);
}

// What is cut short anywhere, or thrown out of, leaves a session that is as good as before.
TEST(Session, LimitsAndExceptionsDoNoHarm) {
  Tally tally;
  for (std::uint32_t seed = 100; seed < 100 + support::scaled(20); ++seed) {
    SCOPED_TRACE(seed);
    RandomSession random(seed, small_roadmap(seed));
    SolveOptions options;
    options.limits.conflicts = 300;
    options.limits.looks = 1000;
    if (seed % 2 == 0) options.joint_work = options.route_work = 0;
    for (int k = 0; k < 12; ++k) {
      random.edit();
      const auto instance = random.session().instance();
      if (!instance) continue;
      SolveOptions cut = options;
      cut.limits.looks = 1 + 7 * k * k;
      if (k % 3 == 0) {
        cut.limits.looks = options.limits.looks;
        cut.progress_interval_s = 0;
        cut.on_progress = [calls = k](const Progress&) mutable {
          if (calls-- == 0) throw std::runtime_error("enough");
        };
      }
      try {
        const auto outcome = random.session().solve(cut);
        if (outcome->plan) {
          ASSERT_TRUE(verify(*instance, *outcome->plan).valid());
        }
      } catch (const std::runtime_error&) {
      }
      expect_equal(*instance, options, random.session().solve(options).value(),
                   solve(*instance, options).value(), tally);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(tally.optimal, 0);
}

/// Vertices in a row, and a way round from the first to the last one.
std::shared_ptr<const Roadmap> ring() {
  return roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 1000}}, {{0, 1}, {1, 2}, {0, 3}, {3, 2}});
}
/// Of the ring: from 0 to 1.
constexpr EdgeId kThere(0);

TEST(Session, ARoadIsClosedAndOpened) {
  Session session(ring());
  const MemberId member = session.add(agent(0, 2, 100)).value();
  EXPECT_EQ(session.solve({})->cost, 2000);
  EXPECT_FALSE(session.close(kThere));
  EXPECT_TRUE(session.is_closed(kThere));
  EXPECT_EQ(session.solve({})->cost, 2828);
  EXPECT_FALSE(session.open(kThere));
  EXPECT_EQ(session.solve({})->cost, 2000);
  EXPECT_FALSE(session.change(member, agent(2, 0, 100)));
  EXPECT_EQ(session.agent(member).goal(), VertexId(0));
  EXPECT_EQ(session.solve({})->cost, 2000);
  EXPECT_FALSE(session.remove(member));
  EXPECT_EQ(session.solve({})->cost, 0);
  EXPECT_TRUE(session.members().empty());
}

TEST(Session, WhoIsUnderWayFinishesItsMove) {
  Session session(ring());
  const MemberId member = session.add(agent(0, 2, 100)).value();
  EXPECT_FALSE(session.close(kThere));
  EXPECT_FALSE(session.put_under_way(member, kThere, 250));
  const SolveOutcome outcome = session.solve({}).value();
  EXPECT_EQ(outcome.cost, 1750);
  EXPECT_EQ(outcome.plan->paths[AgentId(0)].front().vertex, VertexId(4));
  EXPECT_EQ(session.instance()->roadmap().position(VertexId(4)), (Point{250, 0}));
  EXPECT_EQ(session.agent(member).start, VertexId(0));
  // Another one takes the first number among the places.
  const MemberId second = session.add(agent(0, 1, 100)).value();
  EXPECT_FALSE(session.remove(member));
  EXPECT_FALSE(session.put_under_way(second, kThere, 400));
  EXPECT_EQ(session.solve({})->cost, 600);
  EXPECT_EQ(session.instance()->roadmap().position(VertexId(4)), (Point{400, 0}));
}

TEST(Session, MembersKeepTheirNumbers) {
  Session session(ring());
  const MemberId a = session.add(agent(0, 2, 100)).value();
  const MemberId b = session.add(agent(2, 0, 100)).value();
  EXPECT_FALSE(session.remove(a));
  const MemberId c = session.add(agent(3, 3, 100)).value();
  EXPECT_NE(c, a);
  EXPECT_EQ(session.members(), (std::vector<MemberId>{b, c}));
  const Session moved = std::move(session);
  EXPECT_EQ(moved.members(), (std::vector<MemberId>{b, c}));
}

TEST(Session, WhatMakesNoSenseIsRefusedAndChangesNothing) {
  Session session(ring());
  const MemberId member = session.add(agent(0, 2, 100)).value();
  const MemberId nobody(7);
  const auto message = [](const std::optional<Error>& error) {
    return error ? error->message : std::string("none");
  };
  EXPECT_EQ(session.add(agent(0, 9, 100)).error().message, "there is no vertex 9");
  Agent moving = agent(0, 2, 100);
  moving.under_way = true;
  EXPECT_EQ(session.add(moving).error().message, "a member is put under way by its edge");
  EXPECT_EQ(message(session.change(member, agent(9, 0, 100))), "there is no vertex 9");
  EXPECT_EQ(message(session.change(nobody, agent(0, 1, 100))), "there is no member 7");
  EXPECT_EQ(message(session.remove(nobody)), "there is no member 7");
  EXPECT_EQ(message(session.put_under_way(nobody, kThere, 0)), "there is no member 7");
  EXPECT_EQ(message(session.put_under_way(member, EdgeId(99), 0)), "there is no edge 99");
  EXPECT_EQ(message(session.put_under_way(member, kThere, 1000)),
            "member 0 cannot have 1000 ticks of edge 0 behind it, which takes 1000");
  EXPECT_EQ(message(session.put_under_way(member, kThere, -1)),
            "member 0 cannot have -1 ticks of edge 0 behind it, which takes 1000");
  EXPECT_EQ(message(session.close(EdgeId(99))), "there is no edge 99");
  EXPECT_EQ(message(session.open(kThere)), "edge 0 is not closed");
  EXPECT_FALSE(session.close(kThere));
  EXPECT_EQ(message(session.close(kThere)), "edge 0 is closed already");
  EXPECT_FALSE(session.open(kThere));
  EXPECT_EQ(session.solve({})->cost, 2000);

  // Found out when it is solved; what is made good is forgotten.
  const MemberId second = session.add(agent(0, 1, 100)).value();
  EXPECT_EQ(session.solve({}).error().code, ErrorCode::no_plan);
  EXPECT_FALSE(session.change(second, agent(1, 3, 100)));
  EXPECT_EQ(session.solve({})->status, Status::optimal);
}

TEST(Session, ExplanationsAreForWhoAsks) {
  Session session(ring());
  static_cast<void>(session.add(agent(0, 2, 100)).value());
  SolveOptions options;
  EXPECT_FALSE(session.solve(options)->attribution);
  options.explain = true;
  const SolveOutcome outcome = session.solve(options).value();
  ASSERT_TRUE(outcome.attribution);
  EXPECT_EQ(outcome.attribution->lower_bound, 2000);
}

// A bound that the user knows is not passed on as a proof.
TEST(Session, KnownBoundsAreNotInherited) {
  Session session(ring());
  static_cast<void>(session.add(agent(0, 2, 100)).value());
  static_cast<void>(session.add(agent(2, 0, 100)).value());
  const Cost cost = *solve(session.instance().value(), {})->cost;
  SolveOptions options;
  options.known_lower_bound = cost + 500;
  options.limits.wall_s = 0;
  EXPECT_TRUE(session.solve(options)->rests_on_known_bound);
  EXPECT_EQ(session.solve({})->cost, cost);
  EXPECT_EQ(session.solve({})->lower_bound, cost);
}

}  // namespace
}  // namespace quadrille::continuous::test
