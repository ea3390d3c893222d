// SPDX-License-Identifier: MIT
// What scenes leave to the next one is what that one would have computed itself.
#include "traffic/scene_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "continuous/support/random_instance.hpp"
#include "quadrille/core/random.hpp"
#include "support/environment.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous::test {
namespace {

/// Instances on one roadmap, each made of the last one by a few changes.
class Edits {
 public:
  explicit Edits(std::uint32_t seed) : random_(seed) {
    RandomOptions options;
    options.shapes_percent = 0;
    options.num_vertices = 8;
    options.groups_percent = 50;
    const Instance first = random_instance(seed, options);
    base_ = first.shared_roadmap();
    for (const Agent& agent : first.agents()) agents_.push_back(agent);
  }

  [[nodiscard]] const std::shared_ptr<const Roadmap>& base() const { return base_; }

  std::optional<Instance> next() {
    for (std::size_t k = draw(3); k > 0; --k) {
      const EdgeId e(draw(base_->num_edges()));
      if (!closed_.erase(e)) closed_.insert(e);
    }
    if (draw(3) == 0) {
      Agent& agent = agents_[draw(agents_.size())];
      agent.body = Disc{Length(1 + static_cast<std::int64_t>(draw(9)))};
      agent.goals = VertexId(draw(base_->num_vertices()));
    }
    std::vector<Agent> agents = agents_;
    std::vector<Point> points = base_->positions();
    std::vector<Edge> edges = base_->edges();
    if (draw(2) == 0) {
      Agent& agent = agents[draw(agents.size())];
      const Edge& on = base_->edge(EdgeId(draw(base_->num_edges())));
      const Point p = base_->position(on.from), q = base_->position(on.to);
      agent.start = VertexId(points.size());
      agent.under_way = true;
      agent.release = 0;
      points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2});
      edges.push_back({agent.start, on.to, Ticks(1 + static_cast<std::int64_t>(draw(20)))});
    }
    const std::vector<EdgeId> closed(closed_.begin(), closed_.end());
    auto instance = Instance::make(
        Roadmap::make(std::move(points), std::move(edges)).value().with_closed(closed),
        std::move(agents));
    if (!instance) return std::nullopt;
    return std::move(instance).value();
  }

 private:
  [[nodiscard]] std::size_t draw(std::size_t count) {
    return static_cast<std::size_t>(random_.below(count));
  }

  Random random_;
  std::shared_ptr<const Roadmap> base_;
  std::vector<Agent> agents_;
  std::set<EdgeId> closed_;
};

void compare_neighbours(const Contacts::Neighbours& warm, const Contacts::Neighbours& cold,
                        const Instance& instance, ClassId c) {
  EXPECT_EQ(warm.vertices, cold.vertices);
  EXPECT_TRUE(
      std::includes(warm.edges.begin(), warm.edges.end(), cold.edges.begin(), cold.edges.end()));
  for (const EdgeId e : warm.edges)
    EXPECT_TRUE(!instance.may_use(c, e) ||
                std::binary_search(cold.edges.begin(), cold.edges.end(), e));
}

void compare(Scene& warm, Scene& cold) {
  const Instance& instance = cold.instance();
  const Roadmap& roadmap = instance.roadmap();
  const IdRange<EdgeId> edges(roadmap.num_edges());
  const IdRange<VertexId> vertices(roadmap.num_vertices());
  for (const AgentId i : instance.agent_ids()) {
    for (const VertexId v : vertices)
      ASSERT_EQ(warm.task(i).distances[v], cold.task(i).distances[v]);
    ASSERT_EQ(warm.free_cost(i), cold.free_cost(i));
  }
  for (const ClassId a : IdRange<ClassId>(instance.num_classes()))
    for (const ClassId b : IdRange<ClassId>(instance.num_classes())) {
      for (const EdgeId e : edges) {
        for (const EdgeId f : edges)
          ASSERT_EQ(warm.contacts().offsets(a, e, b, f), cold.contacts().offsets(a, e, b, f));
        for (const VertexId v : vertices)
          ASSERT_EQ(warm.contacts().window(a, e, b, v), cold.contacts().window(a, e, b, v));
        compare_neighbours(warm.contacts().near_edge(a, e, b), cold.contacts().near_edge(a, e, b),
                           instance, b);
      }
      for (const VertexId v : vertices)
        compare_neighbours(warm.contacts().near_vertex(a, v, b),
                           cold.contacts().near_vertex(a, v, b), instance, b);
    }
}

TEST(SceneStore, LeavesWhatTheNextSceneWouldCompute) {
  int num_compared = 0;
  for (std::uint32_t seed = 1; seed <= support::scaled(20); ++seed) {
    SCOPED_TRACE(seed);
    Edits edits(seed);
    SceneStore store(edits.base());
    LimitMonitor limits(Limits{});
    for (int step = 0; step < 12; ++step) {
      const auto instance = edits.next();
      if (!instance) continue;
      store.adopt(*instance);
      Scene warm(*instance, limits, &store), cold(*instance, limits);
      ASSERT_TRUE(warm.is_complete() && cold.is_complete());
      compare(warm, cold);
      if (HasFatalFailure()) return;
      ++num_compared;
    }
  }
  EXPECT_GT(num_compared, 0);
}

// The table has room for more keys than a small roadmap has, and hashes those of a large one.
TEST(IntervalTable, ForgetsAllButWhatIsKept) {
  for (const std::size_t size : {20U, 2000U}) {
    IntervalTable table(size, size);
    int num_computed = 0;
    const auto look = [&](std::size_t row, std::size_t column) {
      return table.get(row, column, [&]() -> IntervalTable::Value {
        ++num_computed;
        if ((row + column) % 3 == 0) return std::nullopt;
        return geometry::TickInterval{Ticks(static_cast<std::int64_t>(row)),
                                      Ticks(static_cast<std::int64_t>(row + column + 1))};
      });
    };
    for (std::size_t k = 0; k < 20; ++k)
      for (std::size_t l = 0; l < 20; ++l) static_cast<void>(look(k, l));
    EXPECT_EQ(num_computed, 400);
    table.keep(15, 12);
    for (std::size_t k = 0; k < 20; ++k)
      for (std::size_t l = 0; l < 20; ++l) {
        const auto value = look(k, l);
        ASSERT_EQ(value.has_value(), (k + l) % 3 != 0);
        if (value) {
          EXPECT_EQ(value->end, Ticks(static_cast<std::int64_t>(k + l + 1)));
        }
      }
    EXPECT_EQ(num_computed, 400 + 400 - 15 * 12);
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
