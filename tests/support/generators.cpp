// SPDX-License-Identifier: MIT
#include "support/generators.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace quadrille::discrete::support {
namespace {

using EdgeList = std::vector<std::pair<std::size_t, std::size_t>>;

EdgeList all_pairs(std::size_t n) {
  EdgeList pairs;
  for (std::size_t b = 1; b < n; ++b)
    for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
  return pairs;
}

Graph make_graph(std::size_t n, const EdgeList& edges) {
  std::vector<Graph::Edge> list;
  for (const auto& [a, b] : edges) list.emplace_back(VertexId(a), VertexId(b));
  return Graph::make(n, list).value();
}

bool is_connected(std::size_t n, const EdgeList& edges) {
  std::vector<std::size_t> part(n);
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (const auto& [a, b] : edges) {
    const std::size_t from = part[a], to = part[b];
    std::replace(part.begin(), part.end(), from, to);
  }
  return std::all_of(part.begin(), part.end(), [&](std::size_t p) { return p == part[0]; });
}

EdgeList select(const EdgeList& pairs, std::uint32_t mask) {
  EdgeList edges;
  for (std::size_t e = 0; e < pairs.size(); ++e)
    if ((mask >> e & 1) != 0) edges.push_back(pairs[e]);
  return edges;
}

/// Whether no relabelling of the vertices gives a smaller mask.
bool is_canonical(std::size_t n, const EdgeList& edges, std::uint32_t mask) {
  std::vector<std::size_t> label(n);
  std::iota(label.begin(), label.end(), std::size_t{0});
  do {
    std::uint32_t relabelled = 0;
    for (const auto& [a, b] : edges) {
      const auto [low, high] = std::minmax(label[a], label[b]);
      relabelled |= 1U << (high * (high - 1) / 2 + low);  // the index in all_pairs
    }
    if (relabelled < mask) return false;
  } while (std::next_permutation(label.begin(), label.end()));
  return true;
}

std::vector<std::size_t> sample(Random& random, std::size_t bound, std::size_t count) {
  std::vector<std::size_t> numbers(bound);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  random.shuffle(numbers);
  numbers.resize(count);
  return numbers;
}

}  // namespace

std::vector<Graph> connected_graphs(std::size_t n) {
  QUADRILLE_REQUIRE(n >= 1 && n <= 6, "few enough graphs");
  const EdgeList pairs = all_pairs(n);
  std::vector<Graph> graphs;
  for (std::uint32_t mask = 0; mask < 1U << pairs.size(); ++mask) {
    const EdgeList edges = select(pairs, mask);
    if (is_connected(n, edges) && is_canonical(n, edges, mask))
      graphs.push_back(make_graph(n, edges));
  }
  return graphs;
}

std::vector<std::vector<std::size_t>> arrangements(std::size_t bound, std::size_t length) {
  std::vector<std::vector<std::size_t>> result{{}};
  for (std::size_t i = 0; i < length; ++i) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& tuple : result)
      for (std::size_t next = 0; next < bound; ++next) {
        if (std::find(tuple.begin(), tuple.end(), next) != tuple.end()) continue;
        longer.push_back(tuple);
        longer.back().push_back(next);
      }
    result = std::move(longer);
  }
  return result;
}

Instance random_tasks(Random& random, Graph graph, std::size_t num_agents) {
  const auto starts = sample(random, graph.num_vertices(), num_agents);
  const auto goals = sample(random, graph.num_vertices(), num_agents);
  std::vector<Agent> tasks;
  for (std::size_t i = 0; i < num_agents; ++i)
    tasks.push_back({VertexId(starts[i]), VertexId(goals[i])});
  return Instance::make(std::move(graph), std::move(tasks)).value();
}

Instance with_more_goals(Random& random, const Instance& instance) {
  const std::size_t n = instance.graph().num_vertices();
  std::vector<std::vector<VertexId>> sets;
  for (const Agent& task : instance.agents()) {
    sets.push_back({task.goals.vertices().begin(), task.goals.vertices().end()});
    if (random.percent(75))
      for (std::size_t k = random.between(1, 3); k > 0; --k)
        sets.back().emplace_back(random.below(n));
  }
  const std::size_t kind = random.below(4);
  if (kind == 0) {  // all agents share all goals
    std::vector<VertexId> all;
    for (const auto& set : sets) all.insert(all.end(), set.begin(), set.end());
    std::fill(sets.begin(), sets.end(), all);
  } else if (kind == 1) {  // some share
    for (auto& set : sets)
      if (random.percent(50)) set = random.pick(sets);
  }
  std::vector<Agent> tasks;
  for (const AgentId i : instance.agent_ids())
    tasks.push_back({instance.agents()[i].start, Goals(sets[i.index()])});
  auto made = Instance::make(instance.shared_graph(), std::move(tasks));
  return made ? std::move(made).value() : instance;  // two may have the same only goal
}

Instance with_group_goals(Random& random, const Instance& instance) {
  const std::size_t n = instance.graph().num_vertices();
  const std::size_t groups = random.between(1, instance.num_agents());
  std::vector<std::size_t> group_of, sizes(groups, 0);
  for (std::size_t i = 0; i < instance.num_agents(); ++i) {
    group_of.push_back(random.below(groups));
    ++sizes[group_of.back()];
  }
  std::vector<Goals> sets;
  for (const std::size_t size : sizes) {
    const std::size_t least =
        size > 1 && random.percent(20) ? size - 1 : std::max<std::size_t>(size, 1);
    std::vector<VertexId> goals;
    for (const std::size_t v : sample(random, n, std::min(n, random.between(least, size + 2))))
      goals.emplace_back(v);
    sets.emplace_back(std::move(goals));
  }
  std::vector<Agent> tasks;
  for (const AgentId i : instance.agent_ids())
    tasks.push_back({instance.agents()[i].start, sets[group_of[i.index()]]});
  auto made = Instance::make(instance.shared_graph(), std::move(tasks));
  return made ? std::move(made).value() : instance;  // two may have the same only goal
}

Instance random_grid(Random& random, const GridShape& shape) {
  const std::size_t width = random.between(shape.min_side, shape.max_side);
  const std::size_t height = random.between(shape.min_side, shape.max_side);
  const std::size_t share = random.between(0, shape.max_obstacles_percent);
  std::vector<bool> passable(width * height);
  for (std::size_t c = 0; c < passable.size(); ++c) passable[c] = !random.percent(share);
  passable[random.below(passable.size())] = true;
  Graph graph =
      Graph::grid(static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), passable);
  const std::size_t agents =
      std::min(random.between(shape.min_agents, shape.max_agents), graph.num_vertices());
  return random_tasks(random, std::move(graph), agents);
}

Instance random_graph(Random& random, std::size_t max_vertices, std::size_t max_agents) {
  const std::size_t n = random.between(2, max_vertices);
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t v = 1; v < n; ++v)
    if (!random.percent(5)) edges.emplace(random.below(v), v);
  for (std::size_t extra = random.below(n); extra > 0; --extra) {
    const std::size_t a = random.below(n), b = random.below(n);
    if (a != b) edges.emplace(std::min(a, b), std::max(a, b));
  }
  Graph graph = make_graph(n, EdgeList(edges.begin(), edges.end()));
  return random_tasks(random, std::move(graph), random.between(1, std::min(n, max_agents)));
}

}  // namespace quadrille::discrete::support
