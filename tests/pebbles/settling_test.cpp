// SPDX-License-Identifier: MIT
// Settling without rotations, against all arrangements that moves into free vertices can reach.
#include "quadrille/pebbles/settling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "support/environment.hpp"

namespace quadrille::pebbles {
namespace {

using quadrille::support::scaled;

using Neighbours = std::vector<std::vector<Local>>;

class Draw {
 public:
  explicit Draw(std::uint32_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

/// A random tree, and so many further edges at most.
Neighbours random_graph(Draw& draw, std::size_t size, std::size_t more) {
  std::set<std::pair<Local, Local>> edges;
  for (std::size_t v = 1; v < size; ++v)
    edges.emplace(static_cast<Local>(draw.below(v)), static_cast<Local>(v));
  for (; more > 0; --more) {
    const auto a = static_cast<Local>(draw.below(size)), b = static_cast<Local>(draw.below(size));
    if (a != b) edges.insert(std::minmax(a, b));
  }
  Neighbours neighbours(size);
  for (const auto& [a, b] : edges) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  return neighbours;
}

std::vector<Local> arrangement(Draw& draw, std::size_t size, std::size_t agents) {
  std::vector<Local> all(size);
  std::iota(all.begin(), all.end(), Local{0});
  for (std::size_t k = size; k > 1; --k) std::swap(all[k - 1], all[draw.below(k)]);
  all.resize(agents);
  return all;
}

bool can_be_reached(const Neighbours& neighbours, const std::vector<Local>& start,
                    const std::vector<Local>& goal) {
  std::set<std::vector<Local>> seen{start};
  std::vector<std::vector<Local>> queue{start};
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::vector<Local> at = queue[head];
    if (at == goal) return true;
    for (std::size_t a = 0; a < at.size(); ++a)
      for (const Local w : neighbours[at[a]]) {
        if (std::find(at.begin(), at.end(), w) != at.end()) continue;
        std::vector<Local> next = at;
        next[a] = w;
        if (seen.insert(next).second) queue.push_back(std::move(next));
      }
  }
  return false;
}

/// The shifts; nullopt: given up.
std::optional<std::vector<Shift>> settled(const Neighbours& neighbours,
                                          const std::vector<Local>& start,
                                          const std::vector<Local>& goal) {
  LimitMonitor limits{Limits{}};
  Settling settling(LocalGraph(neighbours), start, goal, Rotations::forbidden);
  auto state = Settling::State::working;
  while (state == Settling::State::working) state = settling.step(limits);
  if (state == Settling::State::given_up) return std::nullopt;
  return settling.shifts();
}

void check_shifts(const Neighbours& neighbours, std::vector<Local> at,
                  const std::vector<Local>& goal, const std::vector<Shift>& shifts) {
  for (const Shift& shift : shifts) {
    ASSERT_FALSE(shift.with_next) << "a rotation";
    ASSERT_EQ(at[shift.agent], shift.from);
    const auto& near = neighbours[shift.from];
    ASSERT_NE(std::find(near.begin(), near.end(), shift.to), near.end());
    ASSERT_EQ(std::find(at.begin(), at.end(), shift.to), at.end()) << "somebody is there";
    at[shift.agent] = shift.to;
  }
  ASSERT_EQ(at, goal);
}

TEST(SettlingWithoutRotations, FindsAWayOnTreesExactlyWhereThereIsOne) {
  Draw draw(1);
  std::size_t found = 0, impossible = 0;
  for (std::size_t round = 0; round < scaled(2000); ++round) {
    const std::size_t size = 2 + draw.below(7),
                      agents = 1 + draw.below(std::min<std::size_t>(size, 5));
    const Neighbours tree = random_graph(draw, size, 0);
    const auto start = arrangement(draw, size, agents), goal = arrangement(draw, size, agents);
    const auto shifts = settled(tree, start, goal);
    ASSERT_EQ(shifts.has_value(), can_be_reached(tree, start, goal)) << "round " << round;
    if (shifts) check_shifts(tree, start, goal, *shifts);
    ++(shifts ? found : impossible);
  }
  EXPECT_GE(found, scaled(500));
  EXPECT_GE(impossible, scaled(200));
}

TEST(SettlingWithoutRotations, WhatItFindsOnGraphsIsAWay) {
  Draw draw(2);
  std::size_t found = 0, missed = 0;
  for (std::size_t round = 0; round < scaled(2000); ++round) {
    const std::size_t size = 3 + draw.below(5),
                      agents = 1 + draw.below(std::min<std::size_t>(size, 5));
    const Neighbours graph = random_graph(draw, size, 1 + draw.below(4));
    const auto start = arrangement(draw, size, agents), goal = arrangement(draw, size, agents);
    const auto shifts = settled(graph, start, goal);
    const bool is_possible = can_be_reached(graph, start, goal);
    if (shifts) {
      ASSERT_TRUE(is_possible);
      check_shifts(graph, start, goal, *shifts);
      ++found;
    } else if (is_possible) {
      ++missed;
    }
  }
  EXPECT_GE(found, scaled(800));
  EXPECT_LE(10 * missed, found) << "with one free vertex on cycles";
  RecordProperty("missed", static_cast<int>(missed));
}

TEST(LocalGraph, FindsItsBlocks) {
  // A triangle, a bridge, and a square.
  const Neighbours graph{{1, 2}, {0, 2}, {0, 1, 3}, {2, 4, 6}, {3, 5}, {4, 6}, {5, 3}};
  const LocalGraph local(graph);
  for (const Local v : {0U, 1U, 2U}) EXPECT_EQ(local.block(v), 0u);
  for (const Local v : {3U, 4U, 5U, 6U}) EXPECT_EQ(local.block(v), 3u);
  EXPECT_TRUE(local.is_bridge(2, 3));
  EXPECT_FALSE(local.is_bridge(3, 6));
  const LocalGraph tree(Neighbours{{1}, {0, 2}, {1}});
  for (const Local v : {0U, 1U, 2U}) EXPECT_FALSE(tree.on_cycle(v));
}

}  // namespace
}  // namespace quadrille::pebbles
