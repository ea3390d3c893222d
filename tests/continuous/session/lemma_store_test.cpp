// SPDX-License-Identifier: MIT
// What of a search's lemmas and cores is passed on to another situation, kind by kind, and that
// they come back as the clauses that they were.
#include "session/lemma_store.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "continuous/support/roads.hpp"
#include "solve/lemma_keeper.hpp"
#include "theory/lemma_auditor.hpp"

namespace quadrille::continuous::test {
namespace {

using Kind = LemmaStock::Kind;

constexpr MemberId kA(0), kB(1), kC(2);
constexpr EdgeId kEdge(0);

/// Vertices in a row, and a way round from the first to the last one.
std::shared_ptr<const Roadmap> ring() {
  return roadmap({{0, 0}, {1000, 0}, {2000, 0}, {1000, 1000}}, {{0, 1}, {1, 2}, {0, 3}, {3, 2}});
}

Situation three_agents() {
  Situation situation;
  situation.tasks.emplace(kA, Task{agent(0, 2, 100)});
  situation.tasks.emplace(kB, Task{agent(2, 0, 100)});
  situation.tasks.emplace(kC, Task{agent(1, 3, 100)});
  situation.closed.insert(kEdge);
  return situation;
}

/// A lemma of each kind about the first two agents, and a core.
Learned learned_of_two() {
  const AgentId a(0), b(1);
  Learned learned;
  LemmaStock& stock = learned.lemmas;
  stock.obstacles = {{a, {Ban::start(kEdge, {0, 10})}, {b}},
                     {b, {Ban::stay(VertexId(1), {5, 9})}, {a}},
                     {a, {}, {}, LemmaStock::Obstacle::Goal{b, VertexId(0), 2500}}};
  stock.lemmas = {{Kind::collision, {}, {0, 1}},
                  {Kind::path, {{a, 2100}}, {0}},
                  {Kind::path, {{a, 2700}}, {0, 2}},
                  {Kind::path, {}, {1}},
                  {Kind::pair, {{a, 2100}, {b, 2100}}, {1}}};
  learned.cores = {{{a, 2100}, {b, 2100}}};
  return learned;
}

struct Passed {
  int collisions = 0, sure = 0, doubtful = 0, pairs = 0, cores = 0;
  friend bool operator==(const Passed&, const Passed&) = default;
};
std::ostream& operator<<(std::ostream& out, const Passed& p) {
  return out << p.collisions << ' ' << p.sure << ' ' << p.doubtful << ' ' << p.pairs << ' '
             << p.cores;
}

/// What is passed on after a change.
Passed passed_after(const std::function<void(Situation&)>& change) {
  LemmaStore store(ring());
  Situation situation = three_agents();
  store.put(situation, learned_of_two());
  change(situation);
  const Learned learned = store.learned(situation);
  Passed passed;
  for (const LemmaStock::Lemma& lemma : learned.lemmas.lemmas) {
    if (lemma.kind == Kind::collision) ++passed.collisions;
    if (lemma.kind == Kind::pair) ++passed.pairs;
    if (lemma.kind == Kind::path) ++(lemma.is_doubtful ? passed.doubtful : passed.sure);
    if (lemma.is_doubtful) {
      EXPECT_TRUE(lemma.levels.empty());
    }
  }
  passed.cores = static_cast<int>(learned.cores.size());
  return passed;
}

constexpr Passed kAll{1, 3, 0, 1, 1}, kNothing{};

TEST(LemmaStore, AllStaysTrueOfTheSameAgents) {
  EXPECT_EQ(passed_after([](Situation&) {}), kAll);
  EXPECT_EQ(passed_after([](Situation& now) { now.closed.insert(EdgeId(3)); }), kAll);
  EXPECT_EQ(passed_after([](Situation& now) { now.tasks.erase(kC); }), kAll);
  EXPECT_EQ(passed_after([](Situation& now) { now.tasks.at(kC).agent.goals = VertexId(0); }), kAll);
  EXPECT_EQ(
      passed_after([](Situation& now) { now.tasks.emplace(MemberId(3), Task{agent(3, 1, 50)}); }),
      kAll);
}

TEST(LemmaStore, AnEdgeThatIsOpenedMakesPathsDoubtful) {
  EXPECT_EQ(passed_after([](Situation& now) { now.closed.clear(); }), (Passed{1, 0, 3, 0, 1}));
}

TEST(LemmaStore, AnotherTaskMakesItsOwnPathsDoubtful) {
  const auto change = [](void (*other)(Agent&)) {
    return passed_after([other](Situation& now) { other(now.tasks.at(kA).agent); });
  };
  const Passed own_paths{1, 1, 2, 0, 0};
  EXPECT_EQ(change([](Agent& a) { a.start = VertexId(3); }), own_paths);
  EXPECT_EQ(change([](Agent& a) { a.goals = VertexId(3); }), own_paths);
  EXPECT_EQ(change([](Agent& a) { a.release = 100; }), own_paths);
  EXPECT_EQ(change([](Agent& a) { a.deadline = Ticks(9000); }), own_paths);
  EXPECT_EQ(change([](Agent& a) { a.leaves = true; }), own_paths);
  EXPECT_EQ(passed_after([](Situation& now) {
              now.tasks.at(kA).under_way = {kEdge, 7};
            }),
            own_paths);
}

// Contacts are those of two bodies at their speeds.
TEST(LemmaStore, OfAnotherBodyNothingIsKnown) {
  const auto change = [](void (*other)(Agent&)) {
    return passed_after([other](Situation& now) { other(now.tasks.at(kA).agent); });
  };
  EXPECT_EQ(change([](Agent& a) { a.body = Disc{99}; }), kNothing);
  EXPECT_EQ(change([](Agent& a) { a.speed = Speed(2 * a.speed.value()); }), kNothing);
  EXPECT_EQ(change([](Agent& a) { a.group = GroupId(1); }), kNothing);
  EXPECT_EQ(passed_after([](Situation& now) { now.tasks.erase(kB); }), kNothing);
}

// The lemma that speaks of b's stay at its goal ends with that goal; with another start it does
// not.
TEST(LemmaStore, GoalStaysEndWithTheGoal) {
  const auto change = [](void (*other)(Agent&)) {
    return passed_after([other](Situation& now) { other(now.tasks.at(kB).agent); });
  };
  EXPECT_EQ(change([](Agent& b) { b.goals = VertexId(3); }), (Passed{1, 1, 1, 0, 0}));
  EXPECT_EQ(change([](Agent& b) { b.leaves = true; }), (Passed{1, 1, 1, 0, 0}));
  EXPECT_EQ(change([](Agent& b) { b.start = VertexId(3); }), (Passed{1, 2, 1, 0, 0}));
}

TEST(LemmaStore, PlacesOfThoseWhoAreUnderWayAreForgotten) {
  LemmaStore store(ring());
  const Situation situation = three_agents();
  const std::size_t num_edges = ring()->num_edges(), num_vertices = ring()->num_vertices();
  Learned learned = learned_of_two();
  learned.lemmas.obstacles[0].bans.push_back(Ban::start(EdgeId(num_edges), {0, 10}));
  store.put(situation, learned);
  EXPECT_EQ(store.learned(situation).lemmas.lemmas.size(), 2U);
  learned = learned_of_two();
  learned.lemmas.obstacles[1].bans.push_back(Ban::stay(VertexId(num_vertices), {0, 10}));
  store.put(situation, learned);
  EXPECT_EQ(store.learned(situation).lemmas.lemmas.size(), 2U);
}

TEST(LemmaStore, AgentsHaveTheirNumbersOfNow) {
  LemmaStore store(ring());
  Situation situation;
  for (const MemberId member : {kA, kB, kC})
    situation.tasks.emplace(MemberId(member.index() + 1), three_agents().tasks.at(member));
  store.put(situation, learned_of_two());
  situation.tasks.emplace(MemberId(0), Task{agent(3, 1, 100)});
  const Learned learned = store.learned(situation);
  EXPECT_EQ(learned.cores, (std::vector<LevelCore>{{{AgentId(1), 2100}, {AgentId(2), 2100}}}));
  EXPECT_EQ(learned.lemmas.obstacles[2].agent, AgentId(1));
  EXPECT_EQ(learned.lemmas.obstacles[2].goal->resident, AgentId(2));
  EXPECT_EQ(learned.lemmas.obstacles[0].partners, std::vector<AgentId>{AgentId(2)});
  EXPECT_EQ(learned.lemmas.lemmas[4].levels[1].agent, AgentId(2));
}

}  // namespace
}  // namespace quadrille::continuous::test
