// SPDX-License-Identifier: MIT
//
// A session in metres is the one in whole units, and answers what a solve of the fleet as it is
// would.
#include "quadrille/fleet/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "fleet/support.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::fleet {
namespace {

using namespace quadrille::units;
using continuous::EdgeId;
using continuous::MemberId;
using continuous::Ticks;
using testing::HasSubstr;

void expect_same(const continuous::Instance& one, const continuous::Instance& other) {
  ASSERT_EQ(one.now(), other.now());
  ASSERT_EQ(one.has_whole_moves(), other.has_whole_moves());
  ASSERT_EQ(one.agents(), other.agents());
  ASSERT_EQ(one.roadmap().positions(), other.roadmap().positions());
  ASSERT_EQ(one.roadmap().edges(), other.roadmap().edges());
  ASSERT_EQ(one.roadmap().lane_places(), other.roadmap().lane_places());
}

/// A session, and one in whole units to which the same is done.
class Twins {
 public:
  Twins(std::uint32_t seed, SolveOptions options)
      : random_(seed), options_(std::move(options)), session_(begin(seed)), units_(units(seed)) {
    const auto instance = begin(seed).fleet().instance();
    if (!instance) return;  // none of them: starts or goals overlap
    for (const AgentId i : instance->agent_ids())
      members_.emplace(session_.fleet().name(i), units_.add(instance->agent(i)).value());
    is_set_up_ = true;
  }
  [[nodiscard]] bool is_set_up() const { return is_set_up_; }

  void go_on() {
    change();
    const auto instance = session_.fleet().instance();
    const auto raw = units_.instance();
    ASSERT_EQ(instance.has_value(), raw.has_value());
    const auto outcome = session_.solve(options_);
    ASSERT_TRUE(outcome.has_value()) << outcome.error().message;
    if (!instance) {
      EXPECT_EQ(outcome->status, Status::infeasible);
      EXPECT_EQ(outcome->explanation, instance.error().message);
      send_all();
      return;
    }
    expect_same(*instance, *raw);
    if (testing::Test::HasFatalFailure()) return;
    continuous::SolveOptions asked;
    static_cast<Choices&>(asked) = options_;
    asked.limits.conflicts = options_.limits.conflicts;
    const auto same = units_.solve(asked).value();
    ASSERT_EQ(outcome->status, same.status);
    ASSERT_EQ(outcome->plan.has_value(), same.plan.has_value());
    EXPECT_EQ(outcome->statistics.conflicts, same.statistics.conflicts);
    const auto fresh = solve(session_.fleet(), options_).value();
    if (is_proof(*outcome) && is_proof(fresh)) {
      ++compared;
      ASSERT_EQ(outcome->status, fresh.status);
      ASSERT_EQ(outcome->cost, fresh.cost);
      ASSERT_EQ(outcome->lower_bound, fresh.lower_bound);
    }
    if (!outcome->plan) {
      send_all();
      return;
    }
    ASSERT_EQ(outcome->plan->in_units(), *same.plan);
    advance(*outcome->plan);
  }

  std::size_t compared = 0, moments = 0, under_way = 0, late = 0;

 private:
  static Session begin(std::uint32_t seed) {
    Fleet fleet = test::random_fleet(seed, 3);
    fleet.release_whole_moves(seed % 2 == 1);
    fleet.begins_at((seed % 3) * 1_s);
    if (seed % 2 == 0) fleet[AgentId(1)].leaves();
    return Session::make(std::move(fleet)).value();
  }
  static continuous::Session units(std::uint32_t seed) {
    const Fleet fleet = begin(seed).fleet();
    const continuous::Resolution sizes = fleet.roadmap().unit_sizes();
    return continuous::Session(fleet.roadmap().in_units(), sizes, {},
                               continuous::quantise_time(fleet.begin().value(), sizes).value(),
                               fleet.releases_whole_moves());
  }
  static bool is_proof(const SolveOutcome& outcome) {
    return outcome.status == Status::optimal || outcome.status == Status::infeasible;
  }

  [[nodiscard]] std::size_t draw(std::size_t count) { return random_.below(count); }
  [[nodiscard]] std::string draw_name() {
    return session_.fleet().name(AgentId(draw(session_.fleet().num_robots())));
  }
  [[nodiscard]] VertexId draw_vertex() {
    return VertexId(draw(session_.fleet().roadmap().num_vertices()));
  }

  void change() {
    const continuous::Roadmap& roads = *session_.fleet().roadmap().in_units();
    if (session_.fleet().num_robots() == 0) return;
    const std::string name = draw_name();
    switch (draw(6)) {
      case 0:
      case 1:
        return send(name);
      case 2: {
        const EdgeId edge(draw(roads.num_edges()));
        const VertexId from = roads.edge(edge).from, to = roads.edge(edge).to;
        const bool is_closed = session_.fleet().is_closed(from, to);
        ASSERT_EQ(is_closed, units_.is_closed(edge));
        ASSERT_FALSE(is_closed ? session_.open(from, to) : session_.close(from, to));
        ASSERT_FALSE(is_closed ? units_.open(edge) : units_.close(edge));
        return;
      }
      case 3: {
        const EdgeId edge(draw(roads.num_edges()));
        const continuous::Edge& lane = roads.edge(edge);
        continuous::Agent agent = units_.agent(members_.at(name));
        const Ticks whole = continuous::travel_time(roads, lane, agent.speed).value();
        const Ticks behind(
            static_cast<std::int64_t>(draw(static_cast<std::size_t>(whole.value()))));
        const double fraction =
            static_cast<double>(behind.value()) / static_cast<double>(whole.value());
        ASSERT_FALSE(session_.change(name, [&](Robot robot) {
          robot.from_edge(lane.from, lane.to, fraction).release(0_s);
        }));
        agent.under_way = false;
        ASSERT_FALSE(units_.change(members_.at(name), agent));
        ASSERT_FALSE(units_.put_under_way(members_.at(name), edge, behind));
        return;
      }
      case 4: {
        continuous::Agent agent = units_.agent(members_.at(name));
        if (agent.under_way) return;
        agent.release = units_.now() + 150;
        agent.start = draw_vertex();
        const Seconds release = at(agent.release);
        ASSERT_FALSE(
            session_.change(name, [&](Robot robot) { robot.from(agent.start).release(release); }));
        ASSERT_FALSE(units_.change(members_.at(name), agent));
        return;
      }
      default:
        if (session_.fleet().num_robots() > 1 && draw(3) == 0) {
          ASSERT_FALSE(session_.remove(name));
          ASSERT_FALSE(units_.remove(members_.at(name)));
          members_.erase(name);
        }
    }
  }
  void send(const std::string& name) {
    const VertexId goal = draw_vertex();
    ASSERT_FALSE(session_.assign(name, goal));
    ASSERT_FALSE(units_.assign(members_.at(name), goal));
  }
  void send_all() {
    for (const auto& [name, member] : members_) send(name);
  }
  [[nodiscard]] Seconds at(Ticks time) const {
    return Seconds(continuous::in_input_units(time, session_.fleet().roadmap().unit_sizes()));
  }

  void advance(const TimedPlan& plan) {
    TimedPlan done = plan;
    if (draw(3) == 0) {  // Everybody is late, where that is allowed.
      continuous::Plan behind = plan.in_units();
      for (continuous::Path& path : behind.paths)
        for (continuous::Stop& stop : path) {
          if (&stop != &path.front()) stop.arrive += 7;
          stop.depart += 7;
        }
      if (const auto made = TimedPlan::make(session_.fleet(), behind)) {
        done = *made;
        ++late;
      }
    }
    const std::int64_t length = continuous::cost(done.in_units(), Objective::makespan);
    const Ticks now =
        units_.now() + Ticks(static_cast<std::int64_t>(draw(static_cast<std::size_t>(length) + 3)));
    const auto error = session_.advance_to(at(now), done);
    ASSERT_FALSE(error) << error->message;
    ASSERT_FALSE(units_.advance_to(now, done.in_units()));
    ASSERT_EQ(session_.now(), at(now));
    const std::vector<MemberId> left = units_.members();
    std::erase_if(members_, [&](const auto& member) {
      return std::find(left.begin(), left.end(), member.second) == left.end();
    });
    ASSERT_EQ(session_.fleet().num_robots(), left.size());
    ++moments;
    for (const AgentId i : session_.fleet().robot_ids())
      under_way += session_.fleet().under_way(i) ? 1 : 0;
  }

  support::Random random_;
  const SolveOptions options_;
  Session session_;
  continuous::Session units_;
  std::map<std::string, MemberId> members_;
  bool is_set_up_ = false;
};

TEST(FleetSession, IsTheOneInWholeUnitsAndAnswersLikeSolve) {
  std::size_t compared = 0, moments = 0, under_way = 0, late = 0, runs = 0;
  const std::size_t count = std::max<std::size_t>(support::scaled(12), 6);
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    SolveOptions options;
    options.objective = seed % 3 == 0 ? Objective::makespan : Objective::sum_of_costs;
    options.limits.conflicts = 100;
    Twins twins(seed, options);
    if (!twins.is_set_up()) continue;
    ++runs;
    for (int k = 0; k < 12; ++k) {
      SCOPED_TRACE(k);
      twins.go_on();
      if (HasFatalFailure()) return;
    }
    compared += twins.compared;
    moments += twins.moments;
    under_way += twins.under_way;
    late += twins.late;
  }
  RecordProperty("compared", static_cast<int>(compared));
  RecordProperty("moments", static_cast<int>(moments));
  EXPECT_GT(runs, 0u);
  EXPECT_GT(compared, runs);
  EXPECT_GT(moments, runs);
  EXPECT_GT(under_way, moments / 4);
  EXPECT_GT(late, 0u);
}

/// Two robots on a road "a" to "d".
class OnARoad : public ::testing::Test {
 protected:
  static Fleet fleet() {
    Fleet fleet(test::line(4));
    fleet.robot({.name = "amr", .body = Disc(0.3_m), .speed = 1_mps}).from(a).to(b);
    fleet.robot({.body = Disc(0.3_m), .speed = 1_mps}).from(d).to(c);
    return fleet;
  }
  /// Why a change was refused; "" if it was not.
  static std::string why(const std::optional<Error>& error) { return error ? error->message : ""; }
  static constexpr VertexId a{0}, b{1}, c{2}, d{3};
  Session session_ = Session::make(fleet()).value();
};

TEST_F(OnARoad, RobotsAreCalledByNames) {
  EXPECT_EQ(session_.fleet().name(AgentId(1)), "robot 1");
  EXPECT_EQ(why(session_.remove("amr")), "");
  EXPECT_EQ(session_.fleet().find("robot 1"), AgentId(0));
  const auto told = [&](Robot robot) { robot.from(a).to(b).deadline(5_s); };
  EXPECT_EQ(why(session_.add({.body = Disc(0.3_m), .speed = 0.5_mps}, told)), "");
  EXPECT_EQ(session_.fleet().find("robot 2"), AgentId(1));
  EXPECT_EQ(session_.solve()->cost, 3_s);
  // Another body without a name keeps it.
  EXPECT_EQ(why(session_.change(
                "robot 2", [](Robot r) { r.becomes({.body = Disc(0.2_m), .speed = 0.25_mps}); })),
            "");
  EXPECT_EQ(session_.fleet().name(AgentId(1)), "robot 2");
  EXPECT_EQ(session_.solve()->cost, 5_s);
  EXPECT_EQ(why(session_.change("robot 2", [](Robot robot) { robot.deadline(3_s); })), "");
  const SolveOutcome late = session_.solve().value();
  EXPECT_EQ(late.status, Status::infeasible);
  EXPECT_THAT(late.explanation, HasSubstr("'robot 2'"));
}

TEST_F(OnARoad, RefusesInTheWordsOfTheFleet) {
  const auto to_c = [&](Robot robot) { robot.from(b).to(c); };
  const auto nothing = [](Robot) {};
  const RobotSpec small{.name = "small", .body = Disc(0.1_m), .speed = 1_mps};
  EXPECT_EQ(why(session_.remove("amr9")), "there is no robot called 'amr9'");
  EXPECT_EQ(why(session_.change("amr9", nothing)), "there is no robot called 'amr9'");
  EXPECT_EQ(why(session_.assign("amr9", a)), "there is no robot called 'amr9'");
  EXPECT_EQ(why(session_.assign("amr", VertexId(7))),
            "'amr' is sent to vertex 7, which the roadmap does not have");
  EXPECT_EQ(why(session_.assign("amr", std::vector<VertexId>{})), "'amr' is sent nowhere");
  EXPECT_EQ(why(session_.add({.name = "amr", .body = Disc(0.3_m), .speed = 1_mps}, to_c)),
            "two robots are called 'amr'");
  EXPECT_EQ(why(session_.add(small, nothing)), "'small' has no goal");
  EXPECT_EQ(why(session_.add({.name = "fat", .body = Disc(0_m), .speed = 1_mps}, to_c)),
            "'fat' has a radius of 0 m, which is not positive, or too large");
  const auto waits = [&](Robot robot) { robot.from_edge(b, c, 0.5).may_wait(); };
  EXPECT_EQ(why(session_.change("amr", waits)),
            "'amr' is under way in a session, where it may not wait");
  const auto jumps = [&](Robot robot) { robot.from_edge(a, c, 0.5); };
  EXPECT_EQ(why(session_.change("amr", jumps)),
            "'amr' is under way, but no lane from a to c is for it");
  const auto renamed = [](Robot r) {
    r.becomes({.name = "robot 1", .body = Disc(0.3_m), .speed = 1_mps});
  };
  EXPECT_EQ(why(session_.change("amr", renamed)), "two robots are called 'robot 1'");
  EXPECT_EQ(why(session_.close(a, c)), "there is no lane from a to c");
  EXPECT_EQ(why(session_.open(a, b)), "the lane from a to b is not closed");
  EXPECT_EQ(why(session_.close(a, b)), "");
  EXPECT_EQ(why(session_.close(a, b)), "the lane from a to b is closed already");
  EXPECT_EQ(session_.solve()->explanation, "'amr' cannot get from a to b");
  EXPECT_EQ(why(session_.open(a, b)), "");
  // What was refused has changed nothing.
  EXPECT_EQ(session_.fleet().num_robots(), 2u);
  EXPECT_EQ(session_.solve()->cost, 2_s);
  Fleet twice = fleet();
  twice.robot({.name = "amr", .body = Disc(0.1_m), .speed = 1_mps}).from(b).to(b);
  EXPECT_EQ(Session::make(twice).error().message, "two robots are called 'amr'");
  Fleet early = fleet();
  early.begins_at(-1_s);
  EXPECT_THAT(Session::make(early).error().message, HasSubstr("the fleet begins at -1 s"));
  SolveOptions options;
  options.gap_percent = -1;
  EXPECT_EQ(session_.solve(options).error().code, ErrorCode::out_of_range);
}

TEST_F(OnARoad, TimeGoesOn) {
  const TimedPlan first = session_.solve()->plan.value();
  EXPECT_EQ(why(session_.advance_to(0.4_s, first)), "");
  EXPECT_EQ(session_.now(), 0.4_s);
  EXPECT_EQ(session_.fleet().under_way(AgentId(0)), (UnderWay{a, b, 0.4}));
  EXPECT_EQ(why(session_.advance_to(0.3_s, first)), "time goes back from 0.4 s to 0.3 s");
  EXPECT_EQ(why(session_.advance_to(0.5_s, first)),
            "'amr' leaves before it arrives, or at a time that is not supported, at 0.4 s");
  EXPECT_THAT(why(session_.advance_to(Seconds(1e300), first)), HasSubstr("or too late"));
  // Who is on a lane that is closed finishes its move.
  EXPECT_EQ(why(session_.close(a, b)), "");
  EXPECT_EQ(why(session_.assign("amr", a)), "");
  const SolveOutcome back = session_.solve().value();
  EXPECT_EQ(back.cost, 0.6_s + 1_s + 0.6_s);
  EXPECT_EQ(why(session_.advance_to(1_s, *back.plan)), "");
  EXPECT_EQ(session_.fleet().start(AgentId(0)), b);
  EXPECT_EQ(session_.fleet().start(AgentId(1)), c);
  Fleet coarse(test::line(4, {.length = 1_cm, .time = 100_ms}));
  coarse.robot({.body = Disc(0.3_m), .speed = 1_mps}).from(b).to(a);
  EXPECT_EQ(why(session_.advance_to(2_s, *solve(coarse)->plan)), "the plan has another resolution");
}

// Rules of the fleet, and robots that begin in the middle of a move, are those of the session.
TEST(FleetSessions, HaveWhatTheFleetHas) {
  for (const bool is_whole : {false, true})
    for (const bool has_obstacle : {false, true})
      for (const bool is_closed : {false, true}) {
        Fleet fleet(test::line(4));
        const VertexId a(0), b(1), c(2), d(3);
        fleet.begins_at(2_s);
        fleet.release_whole_moves(is_whole);
        const Robot first = fleet.robot({.body = Disc(0.1_m), .speed = 1_mps}).from(a).to(c);
        if (!is_whole) first.from_edge(a, b, 0.5);
        fleet.robot({.body = Disc(0.1_m), .speed = 1_mps}).from(b).to(d);
        if (has_obstacle)
          fleet.obstacle({.body = Disc(0.1_m), .path = {{{3_m, 0_m}, 0_s, 9_s}}, .leaves = true});
        if (is_closed) {
          EXPECT_FALSE(fleet.close(d, c));
        }
        const SolveOutcome cold = solve(fleet).value();
        const Seconds one_by_one = has_obstacle ? 15.4_s : 5_s;
        EXPECT_EQ(cold.cost, is_whole ? one_by_one : has_obstacle ? 13.6_s : 3.5_s);
        Session session = Session::make(fleet).value();
        const SolveOutcome warm = session.solve().value();
        ASSERT_EQ(warm.cost, cold.cost);
        EXPECT_EQ(warm.plan->in_units(), cold.plan->in_units());
        EXPECT_EQ(session.open(d, c).has_value(), !is_closed);
      }
}

// A lane that is closed in a fleet is closed to all, and keeps its pace for those who are on it.
TEST(FleetLanes, AreClosedAndOpened) {
  RoadmapBuilder roads;
  const VertexId a = roads.vertex(0_m, 0_m, "a"), b = roads.vertex(4_m, 0_m, "b"),
                 c = roads.vertex(4_m, 3_m, "c");
  roads.road(a, b, {.speed_limit = 0.8_mps}).road(a, c).road(c, b);
  Fleet fleet(roads.build().value());
  const Robot robot =
      fleet.robot({.name = "amr", .body = Disc(0.3_m), .speed = 1_mps}).from(a).to(b);
  EXPECT_EQ(solve(fleet)->cost, 5_s);
  EXPECT_FALSE(fleet.close(a, b));
  EXPECT_TRUE(fleet.is_closed(a, b));
  EXPECT_FALSE(fleet.is_closed(b, a));
  EXPECT_EQ(solve(fleet)->cost, 8_s);
  EXPECT_FALSE(fleet.close(a, c));
  EXPECT_EQ(solve(fleet)->explanation, "'amr' cannot get from a to b");
  robot.from_edge(a, b, 0.75);
  EXPECT_EQ(solve(fleet)->cost, 1.25_s);
  EXPECT_EQ(fleet.close(a, b)->message, "the lane from a to b is closed already");
  EXPECT_EQ(fleet.open(a, VertexId(9))->message, "there is no lane from a to vertex 9");
  EXPECT_FALSE(fleet.open(a, b));
  EXPECT_EQ(fleet.open(a, b)->message, "the lane from a to b is not closed");
  fleet.set_roadmap(roads.build().value());
  EXPECT_FALSE(fleet.is_closed(a, c));
}

}  // namespace
}  // namespace quadrille::fleet
