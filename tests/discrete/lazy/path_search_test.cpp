// SPDX-License-Identifier: MIT
// The searches of the lazy path model, and the separation of paths, against a breadth-first search
// over the time-expanded graph and collisions by their definition.
#include "lazy/path_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "discrete/lazy/situation.hpp"
#include "lazy/separation.hpp"
#include "support/distances.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::discrete {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
using sat::Lit;
using support::Situation;

class NumberingWriter final : public FormulaWriter {
 public:
  [[nodiscard]] Lit new_lit() override { return Lit::from_dimacs(++last_); }
  void add(const sat::Lemma& /*lemma*/) override {}

 private:
  int last_ = 0;
};

Instance random_instance(Random& random) {
  const auto width = static_cast<std::int32_t>(random.between(2, 4));
  const std::size_t size = static_cast<std::size_t>(width) * 3;
  std::vector<VertexId> starts, goals;
  for (std::size_t v = 0; v < size; ++v) starts.push_back(VertexId(v));
  goals = starts;
  random.shuffle(starts);
  random.shuffle(goals);
  std::vector<Agent> tasks;
  for (std::size_t i = 0; i < 4; ++i)
    tasks.push_back(
        {starts[i], random.percent(30) ? Goals({goals[0], goals[1], goals[i]}) : Goals(goals[i])});
  return Instance::make(Graph::grid(width, 3, std::vector<bool>(size, true)), tasks).value();
}

/// Some agents with their current paths, which are cheapest ones, and obstacles for each.
class Scenery {
 public:
  explicit Scenery(std::uint64_t seed) : random_(seed), instance_(random_instance(random_)) {
    for (const AgentId i : instance_.agent_ids()) {
      paths_.replace(i, *search_.find_cheapest(i, {}, kForever - 1).path());
      for (std::size_t n = random_.below(12); n > 0; --n) obstacles_[i].push_back(obstacle(i));
      auto& mine = obstacles_[i];
      std::sort(mine.begin(), mine.end());
      mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
    }
  }

  /// The stack that makes these obstacles active and caps the agent's cost.
  [[nodiscard]] std::vector<Lit> stack(AgentId i, const std::vector<ObstacleId>& active,
                                       Timestep cap) {
    std::vector<Lit> lits{~model_.cost_above(i, cap, writer_)};
    for (const ObstacleId id : active) lits.push_back(~model_.obstacles()[id].allowed);
    return lits;
  }
  /// The least cost of a path around these obstacles; nullopt if it is above the limit.
  [[nodiscard]] std::optional<Timestep> least_cost(AgentId i, const std::vector<ObstacleId>& active,
                                                   Timestep limit) {
    for (Timestep cap = model_.distances(i).free_cost(); cap <= limit; ++cap)
      if (Situation(model_, stack(i, active, cap)).has_path(i)) return cap;
    return std::nullopt;
  }
  /// Of the agent's path with those of the others.
  [[nodiscard]] int num_collisions(AgentId i, const Path& path) const {
    int count = 0;
    for (const AgentId j : instance_.agent_ids()) {
      if (j == i) continue;
      const Path& other = paths_.path(j);
      const auto end = static_cast<Timestep>(std::max(path.size(), other.size()));
      for (Timestep t = 0; t < end; ++t) {
        const VertexId v = position(path, t), w = position(path, t + 1);
        count += position(other, t) == v ? 1 : 0;
        count += v != w && position(other, t) == w && position(other, t + 1) == v ? 1 : 0;
      }
    }
    return count;
  }

  Random random_;
  Instance instance_;
  NumberingWriter writer_;
  LazyModel model_{instance_, support::distances_of(instance_)};
  PathIndex paths_{instance_};
  LimitMonitor unlimited_{Limits{}};
  PathSearch search_{model_, paths_, unlimited_};
  IdVector<AgentId, std::vector<ObstacleId>> obstacles_{instance_.num_agents(),
                                                        std::vector<ObstacleId>{}};

 private:
  ObstacleId obstacle(AgentId i) {
    const Graph& graph = instance_.graph();
    const VertexId v(random_.below(graph.num_vertices()));
    const auto t = static_cast<Timestep>(1 + random_.below(7));
    const Goals& goals = instance_.agents()[i].goals;
    if (!goals.is_single() && random_.percent(20))
      return model_.end(i, goals.vertices().front(), writer_);
    switch (random_.below(4)) {
      case 0:
        return model_.point(i, {v, t}, writer_);
      case 1:
        return model_.edge(i, v, graph.neighbours(v)[random_.below(graph.neighbours(v).size())],
                           t - 1, writer_);
      case 2: {
        // For ever now and then, but not where the agent must come to rest.
        const bool is_endless = !instance_.agents()[i].goals.contains(v) && random_.percent(30);
        const auto length = static_cast<Timestep>(random_.below(5));
        return model_.range(i, v, t, is_endless ? kForever : t + length, writer_);
      }
      default: {
        std::vector<Visit> visits{{v, t}};
        const auto next = graph.neighbours(v);
        visits.push_back({next[random_.below(next.size())], t + 1});
        return model_.barrier(i, visits, writer_);
      }
    }
  }
};

TEST(PathSearch, FindsACheapestPathOrBlamesObstacles) {
  int found = 0, delayed = 0, refused = 0, blamed_some = 0;
  for (std::uint64_t seed = 0; seed < scaled(400) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Scenery scenery(seed);
    for (const AgentId i : scenery.instance_.agent_ids()) {
      const auto& active = scenery.obstacles_[i];
      const Timestep free = scenery.model_.distances(i).free_cost();
      const auto limit = static_cast<Timestep>(free + static_cast<int>(scenery.random_.below(8)));
      const auto expected = scenery.least_cost(i, active, limit);
      const auto cheapest = scenery.search_.find_cheapest(i, active, limit);
      ASSERT_EQ(cheapest.path() != nullptr, expected.has_value());
      if (expected) {
        const Path& path = *cheapest.path();
        EXPECT_EQ(static_cast<Timestep>(path.size()) - 1, *expected);
        const Situation now(scenery.model_, scenery.stack(i, active, *expected));
        EXPECT_EQ(now.find_fault(i, path), "");
        delayed += *expected > free ? 1 : 0;
      }
      ++(expected ? found : refused);
      for (Timestep bound = free; bound <= (expected ? *expected - 1 : limit); ++bound) {
        const auto blamed = cheapest.blame(bound);
        EXPECT_FALSE(scenery.least_cost(i, blamed, bound)) << "bound " << bound;
        for (const ObstacleId id : blamed)
          EXPECT_EQ(std::count(active.begin(), active.end(), id), 1);
        blamed_some += blamed.size() < active.size() ? 1 : 0;
      }
    }
  }
  if (scaled(400) < 400) return;  // too few to count on chance
  EXPECT_GT(found, 500);
  EXPECT_GT(delayed, 100);
  EXPECT_GT(refused, 20);
  EXPECT_GT(blamed_some, 100);
}

TEST(PathSearch, FindsQuieterPathsWithinTheCap) {
  int quieter = 0, none = 0;
  for (std::uint64_t seed = 0; seed < scaled(400) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Scenery scenery(1'000'000 + seed);
    for (const AgentId i : scenery.instance_.agent_ids()) {
      const auto& active = scenery.obstacles_[i];
      const auto cap = static_cast<Timestep>(scenery.model_.distances(i).free_cost() +
                                             static_cast<int>(scenery.random_.below(3)));
      const int now = scenery.num_collisions(i, scenery.paths_.path(i));
      const Path* path = scenery.search_.find_quieter(i, active, cap);
      ++(path != nullptr ? quieter : none);
      if (path == nullptr) continue;
      EXPECT_LT(scenery.num_collisions(i, *path), now);
      EXPECT_EQ(Situation(scenery.model_, scenery.stack(i, active, cap)).find_fault(i, *path), "");
    }
  }
  if (scaled(400) < 400) return;
  EXPECT_GT(quieter, 100);
  EXPECT_GT(none, 100);
}

using PathSearchDeathTest = testing::Test;

TEST(PathSearchDeathTest, OnlyTheLastSearchCanBeAsked) {
  Scenery scenery(1);
  const auto first = scenery.search_.find_cheapest(AgentId(0), {}, kForever - 1);
  EXPECT_NE(first.path(), nullptr);
  static_cast<void>(scenery.search_.find_cheapest(AgentId(1), {}, kForever - 1));
  EXPECT_DEATH(static_cast<void>(first.path()), "the last search is asked");
  EXPECT_DEATH(static_cast<void>(first.blame(9)), "the last search is asked");
}

/// A trail with caps for some agents, and the obstacles that their paths do not break.
class Separated {
 public:
  explicit Separated(std::uint64_t seed) : scenery_(seed) {
    for (const AgentId i : scenery_.instance_.agent_ids()) {
      is_present_.push_back(scenery_.random_.percent(75));
      if (!is_present_[i]) continue;
      const auto cap = static_cast<Timestep>(scenery_.model_.distances(i).free_cost() +
                                             static_cast<int>(scenery_.random_.below(3)));
      caps_.push_back(cap);
      std::vector<ObstacleId> active;
      for (const ObstacleId id : scenery_.obstacles_[i])
        if (!scenery_.model_.obstacles().hits(id, scenery_.paths_.path(i))) active.push_back(id);
      stacks_.push_back(scenery_.stack(i, active, cap));
    }
    trail_.notice(scenery_.model_.obstacles());
    std::size_t k = 0;
    for (const AgentId i : scenery_.instance_.agent_ids()) {
      if (!is_present_[i]) continue;
      for (const Lit lit : stacks_[k])
        if (trail_.value(lit) == sat::Truth::unassigned) push(lit);
      trail_.lower_cap(i, caps_[k++]);
    }
  }

  void push(Lit lit) {
    trail_.push(lit);
    pushed_.push_back(lit);
  }
  /// All collisions of present agents by their definition: agents, time, whether it is a swap.
  using Collision = std::tuple<AgentId, AgentId, Timestep, bool>;
  [[nodiscard]] std::vector<Collision> collisions() const {
    std::vector<Collision> found;
    for (const AgentId i : scenery_.instance_.agent_ids())
      for (const AgentId j : scenery_.instance_.agent_ids()) {
        if (!(i < j) || !is_present_[i] || !is_present_[j]) continue;
        const Path& a = scenery_.paths_.path(i);
        const Path& b = scenery_.paths_.path(j);
        for (Timestep t = 0; t < static_cast<Timestep>(std::max(a.size(), b.size())); ++t) {
          if (position(a, t) == position(b, t)) found.emplace_back(i, j, t, false);
          if (position(a, t) != position(a, t + 1) && position(a, t) == position(b, t + 1) &&
              position(a, t + 1) == position(b, t))
            found.emplace_back(i, j, t, true);
        }
      }
    std::sort(found.begin(), found.end());
    return found;
  }
  void expect_collisions_listed() {
    std::vector<Collision> listed;
    for (const Encounter& e : separation_.collisions())
      listed.emplace_back(std::min(e.first, e.second), std::max(e.first, e.second), e.timestep,
                          e.kind == Encounter::Kind::swap);
    std::sort(listed.begin(), listed.end());
    EXPECT_EQ(listed, collisions());
  }
  void expect_good_paths() {
    const Situation now(scenery_.model_, pushed_);
    for (const AgentId i : scenery_.instance_.agent_ids()) {
      if (!is_present_[i]) continue;
      EXPECT_EQ(now.find_fault(i, scenery_.paths_.path(i)), "") << i.value();
    }
  }

  Scenery scenery_;
  LimitMonitor limits_{Limits{}};
  TrailedPaths trailed_{scenery_.paths_, scenery_.model_};
  LazyTrail trail_{trailed_, scenery_.instance_.num_agents(), lazy::kNoCap};
  Separation separation_{scenery_.paths_, trail_, scenery_.search_, limits_};
  IdVector<AgentId, bool> is_present_;

 private:
  std::vector<Timestep> caps_;
  std::vector<std::vector<Lit>> stacks_;
  std::vector<Lit> pushed_;
};

TEST(Separation, ListsCollisionsAndBypassesThem) {
  int bypassed = 0, kept = 0, collided = 0;
  for (std::uint64_t seed = 0; seed < scaled(1000) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Separated separated(2'000'000 + seed);
    Scenery& scenery = separated.scenery_;
    separated.expect_collisions_listed();
    separated.expect_good_paths();
    collided += separated.collisions().empty() ? 0 : 1;
    for (const AgentId i : scenery.instance_.agent_ids()) {
      if (!separated.is_present_[i]) continue;
      const Path before = scenery.paths_.path(i);
      const int num_before = scenery.num_collisions(i, before);
      const bool has_found = separated.separation_.bypass(i);
      ++(has_found ? bypassed : kept);
      EXPECT_EQ(scenery.paths_.path(i) != before, has_found);
      if (has_found) {
        EXPECT_LT(scenery.num_collisions(i, scenery.paths_.path(i)), num_before);
      }
      separated.expect_collisions_listed();
    }
    while (separated.separation_.bypass_all()) separated.expect_collisions_listed();
    separated.expect_good_paths();
    // Nobody of those who collide could do better alone.
    for (const Encounter& e : std::vector<Encounter>(separated.separation_.collisions()))
      for (const AgentId i : {e.first, e.second}) EXPECT_FALSE(separated.separation_.bypass(i));
  }
  if (scaled(1000) < 1000) return;
  EXPECT_GT(bypassed, 100);
  EXPECT_GT(kept, 100);
  EXPECT_GT(collided, 100);
}

}  // namespace
}  // namespace quadrille::discrete
