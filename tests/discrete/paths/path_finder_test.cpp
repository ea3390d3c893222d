// SPDX-License-Identifier: MIT
// What searches take where the agent has to arrive late, or cannot arrive at all.
#include "paths/path_finder.hpp"

#include <gtest/gtest.h>

#include "discrete/paths/count_collisions.hpp"
#include "support/distances.hpp"

namespace quadrille::discrete {
namespace {

constexpr int kSide = 30;
constexpr std::int64_t kVertices = std::int64_t{kSide} * kSide;
constexpr Timestep kLast = 5000;  // so late somebody passes a goal

VertexId at(int x, int y) { return VertexId(static_cast<std::size_t>(y * kSide + x)); }

class PathFinderEffort : public testing::Test {
 protected:
  PathFinderEffort()
      : instance_(Instance::make(Graph::grid(kSide, kSide, std::vector<bool>(kVertices, true)),
                                 {{at(5, 5), at(20, 20)}, {at(19, 0), at(19, 29)}})
                      .value()),
        table_(support::distances_of(instance_)),
        distances_(instance_, *table_, agent_),
        map_(instance_.graph().num_vertices()),
        others_(instance_) {}

  void block(VertexId v, Timestep first, Timestep last) {
    active_.push_back(obstacles_.add_range(agent_, {}, v, first, last));
    map_.load(obstacles_, active_, distances_);
  }
  void block_around(VertexId v, Timestep first, Timestep last) {
    for (const VertexId w : instance_.graph().neighbours(v)) block(w, first, last);
  }
  bool find(PathFinder& finder, Timestep max_cost) {
    return finder.find_cheapest({agent_, distances_, map_, max_cost, &others_}, path_);
  }
  void expect_path(Timestep cost) {
    ASSERT_EQ(static_cast<Timestep>(path_.size()) - 1, cost);
    EXPECT_EQ(path_.front(), distances_.start());
    EXPECT_EQ(path_.back(), distances_.goals().only());
    for (const ObstacleId id : active_) EXPECT_FALSE(obstacles_.hits(id, path_));
    for (std::size_t t = 1; t < path_.size(); ++t)
      EXPECT_TRUE(path_[t] == path_[t - 1] || instance_.graph().adjacent(path_[t], path_[t - 1]));
  }

  const AgentId agent_{0};
  const Instance instance_;
  const std::shared_ptr<const GoalDistances> table_;
  const AgentDistances distances_;
  ObstacleTable obstacles_;
  std::vector<ObstacleId> active_;
  ObstacleMap map_;
  PathIndex others_;
  Path path_;
};

TEST_F(PathFinderEffort, LateGoalsTakeThatOfAPathAndNobodyIsMet) {
  Path other;  // It comes along beside the goal, again and again.
  for (int round = 0; round < 50; ++round) {
    for (int y = 0; y < kSide; ++y) other.push_back(at(20, y));
    for (int y = kSide - 1; y >= 0; --y) other.push_back(at(19, y));
  }
  for (int y = 0; y < kSide; ++y) other.push_back(at(19, y));
  others_.replace(AgentId(1), other);
  block(distances_.goals().only(), kLast, kLast);
  PathFinder finder(instance_.graph().num_vertices());
  ASSERT_TRUE(find(finder, kForever - 1));
  expect_path(kLast + 1);
  EXPECT_EQ(test::count_collisions(others_, agent_, path_), 0);
  EXPECT_LE(finder.effort(), 2 * kLast);
}

TEST_F(PathFinderEffort, LateGoalsThatCannotBeKeptAtOnceTakeThatOfTheVertices) {
  block(distances_.goals().only(), kLast, kLast);
  block_around(distances_.goals().only(), kLast - 10, kLast + 10);
  block(distances_.goals().only(), kLast - 20, kLast - 15);
  PathFinder finder(instance_.graph().num_vertices());
  ASSERT_TRUE(find(finder, kForever - 1));
  expect_path(kLast + 12);
  EXPECT_LE(finder.effort(), 10 * (kLast + 2) + 2 * kVertices);
}

TEST_F(PathFinderEffort, AgentsThatAreShutInTakeThatOfTheVertices) {
  block_around(distances_.goals().only(), 1, kForever);
  PathFinder finder(instance_.graph().num_vertices());
  EXPECT_FALSE(find(finder, 4000));
  EXPECT_LE(finder.effort(), 6 * kVertices);
}

TEST_F(PathFinderEffort, SafeIntervalsStopAtLimits) {
  Limits few;
  few.looks = 3;
  LimitMonitor limits(few);
  SafeIntervalSearch search(instance_.graph().num_vertices(), &limits);
  block_around(distances_.goals().only(), 1, kForever);
  std::vector<Timestep> first_hits(map_.num_slots(), PathFinder::kNoHit);
  EXPECT_THROW(static_cast<void>(search.find(distances_, map_, 4000, first_hits, path_)),
               LimitReached);
  EXPECT_LE(search.effort(), 3 * 64);
}

}  // namespace
}  // namespace quadrille::discrete
