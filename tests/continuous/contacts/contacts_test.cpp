// SPDX-License-Identifier: MIT
// Contacts of moves and stays against meetings that are found by trying moments.
#include "contacts/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "continuous/support/meeting.hpp"
#include "continuous/support/random_bans.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

template <class Id>
bool has(const std::vector<Id>& sorted, Id id) {
  EXPECT_TRUE(std::is_sorted(sorted.begin(), sorted.end()));
  return std::binary_search(sorted.begin(), sorted.end(), id);
}

struct Case {
  const Instance& instance;
  Contacts& contacts;
  Meetings& meetings;
  ClassId a, b;
};
struct Count {
  int moves = 0, stays = 0, apart = 0;
};

void compare_with_edge(Case& c, EdgeId e, Count& count) {
  const auto& near = c.contacts.near_edge(c.a, e, c.b);
  for (const EdgeId f : IdRange<EdgeId>(c.instance.roadmap().num_edges())) {
    const auto& offsets = c.contacts.offsets(c.a, e, c.b, f);
    const auto& run = c.meetings.moves(c.a, e, c.b, f);
    ASSERT_EQ(offsets.has_value(), run.has_value()) << e.value() << ' ' << f.value();
    ++(run ? count.moves : count.apart);
    if (!run) continue;
    EXPECT_EQ(offsets->first(), run->first);
    EXPECT_EQ(offsets->last(), run->last);
    EXPECT_EQ(has(near.edges, f), c.instance.may_use(c.b, f)) << e.value() << ' ' << f.value();
  }
  for (const VertexId v : IdRange<VertexId>(c.instance.roadmap().num_vertices())) {
    const auto& window = c.contacts.window(c.a, e, c.b, v);
    const auto& clear = c.meetings.stay(c.a, e, c.b, v);
    ASSERT_EQ(window.has_value(), clear.has_value()) << e.value() << ' ' << v.value();
    ++(clear ? count.stays : count.apart);
    if (!clear) continue;
    EXPECT_EQ(window->begin, -clear->after_leaving);
    EXPECT_EQ(window->end, clear->before_arrival);
    EXPECT_TRUE(has(near.vertices, v)) << e.value() << ' ' << v.value();
    EXPECT_EQ(has(c.contacts.near_vertex(c.b, v, c.a).edges, e), c.instance.may_use(c.a, e));
  }
}

TEST(Contacts, AreThoseOfTheMotions) {
  Count count;
  for (std::uint32_t seed = 0; seed < support::scaled(60) && !testing::Test::HasFailure(); ++seed) {
    const Instance instance = small_instance(3'000'000 + seed, 2);
    SCOPED_TRACE("seed " + std::to_string(3'000'000 + seed) + ": " + describe(instance));
    LimitMonitor unlimited{Limits{}};
    Contacts contacts(instance, unlimited);
    Meetings meetings(instance);
    for (std::size_t a = 0; a < instance.num_classes(); ++a)
      for (std::size_t b = 0; b < instance.num_classes(); ++b) {
        Case c{instance, contacts, meetings, ClassId(a), ClassId(b)};
        for (const EdgeId e : IdRange<EdgeId>(instance.roadmap().num_edges()))
          compare_with_edge(c, e, count);
        for (const VertexId v : IdRange<VertexId>(instance.roadmap().num_vertices()))
          for (const VertexId w : IdRange<VertexId>(instance.roadmap().num_vertices())) {
            const Point p = instance.roadmap().position(v), q = instance.roadmap().position(w);
            const bool is_overlap =
                meet({p, p, 0, 1}, instance.body(c.a, instance.roadmap().shape(v)), {q, q, 0, 1},
                     instance.body(c.b, instance.roadmap().shape(w)));
            EXPECT_EQ(contacts.overlap(c.a, v, c.b, w), is_overlap);
            if (is_overlap) {
              EXPECT_TRUE(has(contacts.near_vertex(c.a, v, c.b).vertices, w));
            }
          }
      }
  }
  EXPECT_GT(count.moves, 0);
  EXPECT_GT(count.stays, 0);
  EXPECT_GT(count.apart, 0);
}

// On a line so long that rounding leaves in doubt whether it comes near: there and back bodies are
// not the same, and the one that is larger just reaches who stands beside it.
TEST(Contacts, EachEdgeOfASegmentSpeaksForItself) {
  std::vector<Edge> edges{{VertexId(0), VertexId(1), {}}, {VertexId(1), VertexId(0), {}}};
  edges[1].shape = ShapeId(1);
  for (const Length distance : {Length(1499), Length(1500)}) {
    auto map = Roadmap::make({{0, 0}, {8'000'000, 0}, {4'000'000, distance}}, edges);
    Agent robot{VertexId(0), VertexId(0), Disc{500}};
    robot.shapes = {Disc{1000}};
    const Instance instance = Instance::make(std::move(map).value(), {robot}).value();
    LimitMonitor limits{Limits{}};
    Contacts contacts(instance, limits);
    const ClassId c(0);
    const bool meets = distance < 1500;
    EXPECT_EQ(contacts.near_vertex(c, VertexId(2), c).edges,
              meets ? std::vector{EdgeId(1)} : std::vector<EdgeId>{});
    EXPECT_EQ(contacts.window(c, EdgeId(1), c, VertexId(2)).has_value(), meets);
    EXPECT_FALSE(contacts.window(c, EdgeId(0), c, VertexId(2)));
  }
}

TEST(IntervalTable, ComputesEachKeyOnce) {
  for (const std::size_t columns : {std::size_t{50}, std::size_t{1'000'000}}) {  // plain, hashed
    IntervalTable table(200, columns);
    Draw draw(7);
    std::map<std::pair<std::size_t, std::size_t>, IntervalTable::Value> known;
    for (int k = 0; k < 20'000; ++k) {
      const auto row = static_cast<std::size_t>(draw.number(0, 199));
      const auto column = static_cast<std::size_t>(draw.number(0, 49)) * (columns / 50);
      IntervalTable::Value value;
      if (draw.chance(50)) value = {draw.ticks(-50, 50), Ticks{51}};
      const auto [at, is_new] = known.try_emplace({row, column}, value);
      bool is_computed = false;
      const auto found = table.get(row, column, [&] {
        is_computed = true;
        return value;
      });
      ASSERT_EQ(found, at->second);
      ASSERT_EQ(is_computed, is_new);
    }
    EXPECT_GT(known.size(), 5'000u);
  }
}

TEST(IntervalTable, KeepsNothingWhenTheComputationThrows) {
  for (const std::size_t columns : {std::size_t{50}, std::size_t{1'000'000}}) {
    IntervalTable table(200, columns);
    const auto stop = []() -> IntervalTable::Value { throw LimitReached{}; };
    EXPECT_THROW(static_cast<void>(table.get(3, 4, stop)), LimitReached);
    const geometry::TickInterval interval{1, 2};
    EXPECT_EQ(table.get(3, 4, [&] { return IntervalTable::Value{interval}; }), interval);
    EXPECT_EQ(table.get(3, 4, stop), interval);
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
