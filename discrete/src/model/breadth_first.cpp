// SPDX-License-Identifier: MIT
#include "model/breadth_first.hpp"

#include <algorithm>

namespace quadrille::discrete {
namespace {

std::uint32_t index_of(VertexId v) { return v.value(); }
std::uint32_t index_of(std::uint32_t v) { return v; }

}  // namespace

BreadthFirst::BreadthFirst(const Graph& graph)
    : graph_(graph),
      distances_(graph.num_vertices() + 1, kUnreachable),
      queue_(graph.num_vertices() + 1) {
  const IdRange<VertexId> vertices(graph.num_vertices());
  distances_.back() = 0;  // What the lists are filled up with is never reached.
  for (const VertexId v : vertices)
    if (graph.predecessors(v).size() > 4) return;
  near_.resize(graph.num_vertices());
  for (const VertexId v : vertices) {
    auto& near = near_[v.index()];
    near.fill(static_cast<std::uint32_t>(graph.num_vertices()));
    std::transform(graph.predecessors(v).begin(), graph.predecessors(v).end(), near.begin(),
                   [](VertexId w) { return w.value(); });
  }
}

bool BreadthFirst::run(std::span<const VertexId> sources, LimitMonitor* limits) {
  begin(sources);
  if (!near_.empty())
    return spread(kUnreachable, limits, [&](std::uint32_t v) { return std::span(near_[v]); });
  return spread(kUnreachable, limits,
                [&](std::uint32_t v) { return graph_.predecessors(VertexId(v)); });
}

void BreadthFirst::run_within(VertexId source, Timestep moves) {
  begin(std::span<const VertexId>(&source, 1));
  static_cast<void>(
      spread(moves, nullptr, [&](std::uint32_t v) { return graph_.predecessors(VertexId(v)); }));
}

void BreadthFirst::begin(std::span<const VertexId> sources) {
  if (num_reached_ > distances_.size() / 8)
    std::fill(distances_.begin(), distances_.end() - 1, kUnreachable);
  else
    for (const std::uint32_t v : order()) distances_[v] = kUnreachable;
  num_reached_ = 0;
  for (const VertexId source : sources) {
    queue_[num_reached_++] = source.value();
    distances_[source.index()] = 0;
  }
}

template <class Neighbours>
bool BreadthFirst::spread(Timestep most, LimitMonitor* limits, const Neighbours& neighbours) {
  std::size_t tail = num_reached_;
  for (std::size_t head = 0; head < tail; ++head) {
    if (head % 4096 == 4095 && limits != nullptr && limits->exhausted_now()) {
      num_reached_ = tail;
      return false;
    }
    const std::uint32_t v = queue_[head];
    const Timestep distance = distances_[v];
    if (distance == most) break;
    for (const auto near : neighbours(v)) {
      const auto w = index_of(near);
      const bool is_new = distances_[w] == kUnreachable;
      distances_[w] = is_new ? distance + 1 : distances_[w];
      queue_[tail] = w;  // There is room for one more than all vertices.
      tail += is_new ? 1 : 0;
    }
  }
  num_reached_ = tail;
  return true;
}

}  // namespace quadrille::discrete
