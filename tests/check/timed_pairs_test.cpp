// SPDX-License-Identifier: MIT
// The checker's rule for two agents at once, against a replay of all that they can do, tick by
// tick, which shares nothing with it, and by hand, with neighbours that are false.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "certificate/pair_contacts.hpp"
#include "certificate/standing_bans.hpp"
#include "check/timed_support.hpp"
#include "continuous/support/random_instance.hpp"
#include "continuous/support/whole_places.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"
#include "theory/pair_replay.hpp"

namespace quadrille::continuous::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
using quadrille_check::Int;
using quadrille_check::parse_json;
using quadrille_check::read_road;
using quadrille_check::Record;
using quadrille_check::Rejected;
using quadrille_check::Road;
using quadrille_check::TimedChecker;
using quadrille_check::support::accepts;
using quadrille_check::support::checked;
using quadrille_check::support::records_of;

// ---- by hand ------------------------------------------------------------------------------------

// Edges: 0: 0 - 1, 1: 1 - 0, 2: 1 - 2, 3: 2 - 1, and to the pocket 3 above the middle, 4: 1 - 3, 5:
// 3 - 1. Two agents change places. Who waits in the pocket costs 40; the other one sets out at 9 at
// the earliest, and costs 29.
Road pocket(const std::string& first, const std::string& second) {
  const auto agent = [](int start, int goal, const std::string& more) {
    return R"({"start": )" + std::to_string(start) + R"(, "goal": )" + std::to_string(goal) +
           R"(, "radius": 3)" + more + "}";
  };
  return read_road(
      parse_json(R"({"quadrille": "instance", "version": 1, "resolution": 1, "roadmap": {
      "vertices": [[0, 0], [10, 0], [20, 0], [10, 10]],
      "edges": [[0, 1], [1, 0], [1, 2], [2, 1], [1, 3], [3, 1]]}, "agents": [)" +
                 agent(0, 2, first) + ", " + agent(2, 0, second) + "]}"));
}
const Road kPocket = pocket("", "");
const std::string kContacts =
    // Moves: face to face, to the middle from both sides, from there to both.
    "m 0 0 1 0 1 -10 11\nm 0 2 1 0 3 -10 11\nm 0 0 1 0 3 -5 6\nm 0 2 1 0 1 -5 6\n"
    // Those from and to the pocket with those on the lane.
    "m 0 4 1 0 3 -10 -1\nm 0 5 1 0 1 2 11\nm 0 5 1 0 3 -5 6\nm 0 4 1 0 1 -5 6\n"
    "m 1 4 0 0 0 -10 -1\nm 1 5 0 0 2 2 11\nm 1 5 0 0 0 -5 6\nm 1 4 0 0 2 -5 6\n"
    // To and from where the other one stands.
    "m 0 0 1 1 1 4 11\nm 0 2 1 1 1 -1 6\nm 0 2 1 1 2 4 11\nm 0 0 1 1 0 -1 6\n"
    "m 1 3 0 1 1 4 11\nm 1 1 0 1 1 -1 6\nm 1 1 0 1 0 4 11\nm 1 3 0 1 2 -1 6\n"
    "m 0 4 1 1 1 -1 6\nm 0 5 1 1 1 4 11\nm 1 4 0 1 1 -1 6\nm 1 5 0 1 1 4 11\n";

std::string pair_clause(int most, int other_most) {
  return "c 1 0 " + std::to_string(most) + "\nc 2 1 " + std::to_string(other_most) +
         "\na 14 0 1 | -1 -2\n";
}

TEST(TimedPairs, TwoDoNotChangePlacesAsIfAlone) {
  for (const auto& [most, other] : {std::pair{20, 20}, {40, 28}, {28, 60}, {39, 39}}) {
    EXPECT_TRUE(accepts(kPocket, kContacts + pair_clause(most, other))) << most;
    EXPECT_TRUE(accepts(kPocket, kContacts + pair_clause(other, most))) << most;
  }
  EXPECT_FALSE(accepts(kPocket, kContacts + pair_clause(40, 29)));
  EXPECT_FALSE(accepts(kPocket, kContacts + pair_clause(29, 40)));
  EXPECT_FALSE(accepts(kPocket, pair_clause(20, 20)));  // nothing is said of when they meet
  EXPECT_FALSE(accepts(kPocket, kContacts + pair_clause(90, 90)));
  EXPECT_FALSE(accepts(kPocket, kContacts + "c 1 0 29\nc 2 1 20\na 14 0 1 | -1\n"));
  EXPECT_FALSE(accepts(kPocket, kContacts + "c 1 0 29\nc 2 1 20\na 14 0 1 | -1 2\n"));
  EXPECT_FALSE(accepts(kPocket, kContacts + "c 1 0 20\nc 2 1 20\na 14 0 0 | -1 -2\n"));
  EXPECT_FALSE(accepts(kPocket, kContacts + "c 1 0 20\nc 2 1 20\na 14 0 | -1 -2\n"));
}

TEST(TimedPairs, RulesOfAgentsHold) {
  // Who is gone is not in the way: of one that ends in the middle.
  const auto crossing = [](const std::string& more) {
    return read_road(
        parse_json(R"({"quadrille": "instance", "version": 1, "resolution": 1, "roadmap": {
        "vertices": [[0, 0], [10, 0], [20, 0], [10, 10]], "edges": [[0, 1], [1, 2], [3, 1]]},
        "agents": [{"start": 0, "goal": 2, "radius": 3}, {"start": 3, "goal": 1, "radius": 3)" +
                   more + "}]}"));
  };
  const std::string contacts = "m 0 0 1 1 1 4 11\nm 0 1 1 1 1 -1 6\nm 1 2 0 1 1 4 11\n";
  EXPECT_TRUE(accepts(crossing(""), contacts + pair_clause(25, 14)));
  EXPECT_FALSE(accepts(crossing(R"(, "at_goal": "leave")"), contacts + pair_clause(25, 14)));
  EXPECT_TRUE(accepts(pocket(R"(, "deadline": 28)", ""), kContacts + "c 2 1 60\na 14 0 1 | -2\n"));
  EXPECT_FALSE(accepts(pocket(R"(, "deadline": 29)", ""), kContacts + "c 2 1 60\na 14 0 1 | -2\n"));
  EXPECT_TRUE(accepts(pocket(R"(, "release": 1)", ""), kContacts + pair_clause(40, 39)));
  EXPECT_FALSE(accepts(kPocket, kContacts + pair_clause(40, 39)));
  EXPECT_TRUE(accepts(pocket("", R"(, "release": 10)"), kContacts + pair_clause(40, 29)));
  EXPECT_FALSE(accepts(pocket("", R"(, "release": 9)"), kContacts + pair_clause(40, 29)));
}

TEST(TimedPairs, BansHoldOfBoth) {
  // The pocket is closed to the first one, or to both: of each one starts there.
  const std::string bans = "f 3 0 4 0 4 0 -1\nf 4 1 4 0 4 0 -1\nf 5 1 4 1 3 0 100\n";
  const std::string costs = kContacts + bans + "c 1 0 60\nc 2 1 60\n";
  EXPECT_FALSE(accepts(kPocket, costs + "a 14 0 1 | -1 -2 -3\n"));
  EXPECT_FALSE(accepts(kPocket, costs + "a 14 0 1 | -1 -2 -4\n"));
  EXPECT_TRUE(accepts(kPocket, costs + "a 14 0 1 | -1 -2 -3 -4\n"));
  EXPECT_TRUE(accepts(kPocket, costs + "a 14 0 1 | -1 -2 -3 -5\n"));
  EXPECT_FALSE(accepts(kPocket, costs + "a 14 0 1 | -1 -2 3 -4\n"));
  EXPECT_FALSE(accepts(kPocket, costs + "a 14 0 1 3 4 | -1 -2\n"));  // nothing says why they hold
}

TEST(TimedPairs, ContactsAreThoseOfTheBodies) {
  EXPECT_TRUE(accepts(kPocket, kContacts));
  for (const char* contact :
       {"m 0 0 1 0 1 -11 11", "m 0 0 1 0 1 -10 12", "m 0 0 1 1 1 3 11", "m 0 0 1 1 1 4 12",
        "m 0 0 1 0 4 0 30", "m 0 0 1 1 1 4 4", "m 0 0 1 1 1 4 -1", "m 0 0 1 2 1 4 11",
        "m 0 0 1 1 4 4 11", "m 0 6 1 1 1 4 11", "m 2 0 1 1 1 4 11", "m 0 0 2 1 1 4 11",
        "m 0 0 1 1 1 4", "m 0 0 1 1 1 4 11 0", "m 0 0 1 1 1 -9000000000000 11"})
    EXPECT_FALSE(accepts(kPocket, std::string(contact) + "\n")) << contact;
  // Another body meets at other times.
  const Road slim = pocket("", R"(, "speed": 2)");
  EXPECT_FALSE(accepts(slim, "m 0 0 1 0 1 -10 11\n"));
  EXPECT_TRUE(accepts(slim, "m 0 0 1 0 1 -5 11\n"));
}

// ---- at random ----------------------------------------------------------------------------------

struct Case {
  Instance instance;
  std::vector<Ban> bans[2];
  Cost most[2] = {0, 0};
};

Case draw(std::uint32_t seed) {
  Random random(seed);
  RandomOptions asked;
  asked.shapes_percent = asked.no_waiting_percent = 0;  // refused
  asked.num_agents = 2;
  asked.num_vertices = 4 + seed % 4;
  asked.edge_percent = 40 + static_cast<int>(seed / 4 % 2) * 20;
  asked.size = 25;
  asked.under_way_percent = 10;
  asked.obstacles_percent = 0;
  asked.max_radius = 6;
  auto placed = in_whole_places(random_instance(seed, asked));
  if (!placed) {  // too large: nobody is under way
    asked.under_way_percent = 0;
    placed = random_instance(seed, asked);
  }
  Case drawn{std::move(placed).value(), {}, {}};
  LimitMonitor limits({});
  Scene scene(drawn.instance, limits);
  const Roadmap& roadmap = drawn.instance.roadmap();
  for (const std::size_t side : {0U, 1U}) {
    drawn.most[side] = scene.free_cost(AgentId(side)) +
                       static_cast<Cost>(random.below(random.percent(50) ? 4 : 60));
    if (random.percent(50)) continue;
    for (std::size_t k = random.between(1, 3); k > 0; --k) {
      const Ticks begin = Ticks(static_cast<std::int64_t>(random.below(60)) - 1);
      const TickInterval when{begin,
                              begin + Ticks(static_cast<std::int64_t>(random.between(1, 12)))};
      const bool is_move = roadmap.num_edges() > 0 && random.percent(50);
      drawn.bans[side].push_back(
          is_move ? Ban::start(EdgeId(random.below(roadmap.num_edges())), when)
                  : Ban::stay(VertexId(random.below(roadmap.num_vertices())), when));
    }
  }
  return drawn;
}

/// All that the checker needs, and the clause at the end: that the two do not both keep their bans
/// and costs.
std::vector<Record> proof(const Case& c) {
  LimitMonitor limits({});
  Scene scene(c.instance, limits);
  sat::CertificateWriter writer;
  writer.record('i', {2, 0});
  PairContacts contacts(scene);
  std::vector<sat::Lit> clause;
  for (const int side : {0, 1}) {
    sat::ProofMeanings::declare_cost(2 * side + 1, AgentId(static_cast<std::size_t>(side)),
                                     c.most[side], writer);
    declare_bans(2 * side + 2, AgentId(static_cast<std::size_t>(side)), c.bans[side], writer);
    clause.push_back(sat::Lit::from_dimacs(-2 * side - 1));
    clause.push_back(sat::Lit::from_dimacs(-2 * side - 2));
  }
  contacts.write({AgentId(0), c.most[0]}, {AgentId(1), c.most[1]}, writer);
  const std::int64_t both[] = {0, 1};
  static_cast<void>(writer.axiom(14, both, clause));
  return records_of("qcert 1 bin\n" + writer.text());
}

bool is_accepted(const Road& road, const std::vector<Record>& records) {
  TimedChecker checker(road);
  try {
    for (const Record& record : records) checker.check(record);
    return true;
  } catch (const Rejected&) {
    return false;
  }
}

std::optional<bool> has_plan(const Case& c) {
  LimitMonitor limits({});
  const Scene scene(c.instance, limits);
  PairReplay::Party parties[2];
  for (const std::size_t side : {0U, 1U}) {
    std::vector<Ban> bans = scene.standing_bans(AgentId(side));
    bans.insert(bans.end(), c.bans[side].begin(), c.bans[side].end());
    parties[side] = {AgentId(side), Ticks(c.most[side] + 1), bans};
  }
  return PairReplay(c.instance, parties[0], parties[1]).has_plan(200'000);
}

/// Makes what the first one may cost the least with which they have a plan, if that is some ticks
/// more: where a single tick counts.
void tighten(Case& c) {
  Case more = c;
  more.most[0] += 40;
  if (has_plan(c) != std::optional(false) || has_plan(more) != std::optional(true)) return;
  for (Cost low = c.most[0]; low + 1 < more.most[0];) {
    Case middle = c;
    middle.most[0] = (low + more.most[0]) / 2;
    if (has_plan(middle).value_or(true))
      more = middle;
    else
      low = middle.most[0];
  }
  c = more;
}

TEST(TimedPairs, AreRefutedExactlyBelowTheLeastCost) {
  std::size_t least = 0;
  for (std::uint32_t seed = 100'000; seed < 100'000 + scaled(1500); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case c = draw(seed);
    const Cost most = c.most[0];
    tighten(c);
    if (c.most[0] == most) continue;
    ++least;
    const Road road = checked(c.instance);
    ASSERT_FALSE(is_accepted(road, proof(c))) << describe(c.instance);
    --c.most[0];
    ASSERT_TRUE(is_accepted(road, proof(c))) << describe(c.instance);
  }
  EXPECT_GT(least, 0U);
  RecordProperty("cases", static_cast<int>(least));
}

TEST(TimedPairs, AreRefutedExactlyWhereTheyHaveNoPlan) {
  std::size_t some = 0, none = 0, broken = 0;
  for (std::uint32_t seed = 0; seed < scaled(3000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = draw(seed);
    const auto expected = has_plan(c);
    if (!expected) continue;
    const Road road = checked(c.instance);
    const auto records = proof(c);
    ASSERT_EQ(is_accepted(road, records), !*expected) << describe(c.instance);
    ++(*expected ? some : none);
    if (!*expected) continue;
    // Whatever contacts are made of it, they do not refute a plan.
    Random random(seed);
    for (int k = 0; k < 10; ++k) {
      auto other = records;
      for (Record& record : other)
        if (record.tag == 'm' && random.percent(20))
          record.values[random.below(7)] += random.percent(50) ? 1 : -1;
      TimedChecker checker(road);
      for (const Record& record : other) {
        try {
          checker.check(record);
          ASSERT_NE(record.tag, 'a');
        } catch (const Rejected&) {
          broken += record.tag == 'm' ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(some, 0U);
  EXPECT_GT(none, 0U);
  EXPECT_GT(broken, 0U);
  RecordProperty("with a plan", static_cast<int>(some));
  RecordProperty("without", static_cast<int>(none));
}

}  // namespace
}  // namespace quadrille::continuous::test
