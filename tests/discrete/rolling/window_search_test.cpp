// SPDX-License-Identifier: MIT
#include "rolling/window_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "discrete/rolling/crowds.hpp"
#include "support/environment.hpp"

namespace quadrille::discrete {
namespace {

/// The least cost of any path, by looking at all of them: every walk of the window's length.
class Enumeration {
 public:
  Enumeration(const Graph& graph, const std::vector<Path>& others, const Errand& errand,
              const IdVector<VertexId, Timestep>& distances)
      : graph_(graph), others_(others), errand_(errand), distances_(distances) {}

  std::optional<Timestep> least(VertexId start, std::size_t length) {
    length_ = length;
    best_.reset();
    Path path{start};
    extend(path);
    return best_;
  }

 private:
  [[nodiscard]] bool is_free(const Path& path, VertexId to) const {
    const std::size_t t = path.size();
    return std::none_of(others_.begin(), others_.end(), [&](const Path& other) {
      return other[t] == to || (other[t] == path.back() && other[t - 1] == to);
    });
  }
  [[nodiscard]] std::optional<std::size_t> arrival(const Path& path) const {
    if (errand_.goals == nullptr) return std::nullopt;
    for (std::size_t t = 0; t < path.size(); ++t)
      if (errand_.goals->contains(path[t])) return t;
    return std::nullopt;
  }
  [[nodiscard]] bool has_to_stay(const Path& path) const {
    const std::size_t t = path.size() - 1;
    if (t < static_cast<std::size_t>(errand_.hold)) return true;
    const auto come = arrival(path);
    return come && t < *come + static_cast<std::size_t>(errand_.service);
  }
  void extend(Path& path) {
    if (path.size() == length_ + 1) {
      const auto come = arrival(path);
      const Timestep cost = errand_.goals == nullptr ? 0
                            : come                   ? static_cast<Timestep>(*come)
                                   : static_cast<Timestep>(length_) + distances_[path.back()];
      best_ = std::min(best_.value_or(cost), cost);
      return;
    }
    std::vector<VertexId> ways{path.back()};
    if (!has_to_stay(path))
      for (const VertexId v : graph_.neighbours(path.back())) ways.push_back(v);
    for (const VertexId v : ways) {
      if (!is_free(path, v)) continue;
      path.push_back(v);
      extend(path);
      path.pop_back();
    }
  }

  const Graph& graph_;
  const std::vector<Path>& others_;
  const Errand& errand_;
  const IdVector<VertexId, Timestep>& distances_;
  std::size_t length_ = 0;
  std::optional<Timestep> best_;
};

TEST(WindowSearch, FindsCheapestPaths) {
  support::Random random(3);
  std::size_t num_found = 0, num_lost = 0, num_inside = 0;
  for (std::size_t round = 0; round < support::scaled(3000); ++round) {
    const Graph graph = test::small_grid(random);
    const std::size_t num_agents = random.between(2, 6);
    const auto length = static_cast<Timestep>(random.between(1, 7));
    const auto places = test::some_places(random, graph, num_agents);
    const auto paths = test::random_walks(random, graph, places, static_cast<std::size_t>(length));
    Window window(graph.num_vertices(), places, length);
    for (std::size_t t = 1; t <= static_cast<std::size_t>(length); ++t) {
      std::vector<VertexId> at;
      for (const Path& path : paths) at.push_back(path[t]);
      window.push(at);
    }
    const AgentId first(0);
    EXPECT_EQ(window.path(first), paths[0]);
    window.take_out(first);
    const Goals goals(test::some_places(random, graph, random.between(1, 2)));
    ChangingGoalDistances distances(graph, num_agents);
    distances.set(first, goals);
    Errand errand;
    if (!random.percent(15)) errand.goals = &goals;
    errand.service = static_cast<Timestep>(random.below(4));
    errand.hold = random.percent(20) ? static_cast<Timestep>(random.below(4)) : 0;
    Random draws(round);
    WindowSearch search(graph, window, draws);
    const auto row = distances.table().row(first);
    const auto* const found = search.find(places[0], errand, row, 1000, 1'000'000);
    const std::vector<Path> others(paths.begin() + 1, paths.end());
    const auto exact = distances_to_nearest(graph, goals);
    const auto best = Enumeration(graph, others, errand, exact)
                          .least(places[0], static_cast<std::size_t>(length));
    ASSERT_EQ(found != nullptr, best.has_value()) << round;
    if (found == nullptr) {
      ++num_lost;
      continue;
    }
    ++num_found;
    ASSERT_EQ(found->cost, *best) << round;
    num_inside += found->arrival ? 1U : 0U;
    EXPECT_EQ(found->arrival.value_or(*best), *best) << round;
    for (Timestep t = 0; t < length; ++t) {
      const auto at = static_cast<std::size_t>(t);
      const VertexId from = found->path[at], to = found->path[at + 1];
      EXPECT_TRUE(from == to || graph.adjacent(from, to)) << round;
      EXPECT_TRUE(window.is_free(from, to, t)) << round;
      const bool serves = found->arrival && t >= *found->arrival && t < *best + errand.service;
      EXPECT_TRUE(from == to || (t >= errand.hold && !serves)) << round;
    }
    // It is not found if it may not cost as much, or be looked for as long.
    const Timestep cost = found->cost;
    EXPECT_EQ(search.find(places[0], errand, row, cost - 1, 1'000'000), nullptr) << round;
    EXPECT_EQ(search.find(places[0], errand, row, cost, 0), nullptr) << round;
  }
  EXPECT_GT(num_found, 10 * num_lost);
  EXPECT_GT(num_inside, num_found / 4);
}

TEST(Window, GoesOn) {
  Window window(4, std::vector<VertexId>{VertexId(0), VertexId(3)}, 2);
  window.push(std::vector<VertexId>{VertexId(1), VertexId(3)});
  window.push(std::vector<VertexId>{VertexId(2), VertexId(3)});
  for (int k = 0; k < 5; ++k) {
    window.pop();
    EXPECT_EQ(window.length(), 1);
    EXPECT_EQ(window.who(VertexId(3), 0), 1U);
    window.push(window.path(AgentId(0)).back() == VertexId(2)
                    ? std::vector<VertexId>{VertexId(1), VertexId(3)}
                    : std::vector<VertexId>{VertexId(2), VertexId(3)});
    for (Timestep t = 0; t <= 2; ++t) {
      std::size_t num_there = 0;
      for (std::size_t v = 0; v < 4; ++v)
        num_there += window.who(VertexId(v), t) == Window::kNobody ? 0U : 1U;
      EXPECT_EQ(num_there, 2U);
      EXPECT_EQ(window.who(window.at(AgentId(0), t), t), 0U);
    }
  }
}

}  // namespace
}  // namespace quadrille::discrete
