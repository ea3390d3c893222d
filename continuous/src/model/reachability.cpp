// SPDX-License-Identifier: MIT
#include "model/reachability.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

}  // namespace

Reachability::Reachability(const Roadmap& roadmap, GroupId group)
    : roadmap_(roadmap),
      group_(group),
      component_(roadmap.num_vertices(), kNone),
      order_(roadmap.num_vertices(), kNone),
      low_(roadmap.num_vertices()),
      seen_(roadmap.num_vertices(), 0) {
  for (const VertexId v : IdRange<VertexId>(roadmap.num_vertices()))
    if (order_[v.index()] == kNone) search(v);
}

// Tarjan's algorithm without recursion.
void Reachability::search(VertexId root) {
  enter(root);
  while (!frames_.empty()) {
    const VertexId v = frames_.back().vertex;
    const auto out = roadmap_.out_edges(v);
    if (frames_.back().next == out.size()) {
      leave(v);
      continue;
    }
    const Edge& edge = roadmap_.edge(out[frames_.back().next++]);
    const std::size_t w = edge.to.index();
    if (!edge.open_to.contains(group_)) continue;
    if (order_[w] == kNone)
      enter(edge.to);
    else if (component_[w] == kNone)
      low_[v.index()] = std::min(low_[v.index()], order_[w]);
  }
}

void Reachability::enter(VertexId v) {
  order_[v.index()] = low_[v.index()] = num_entered_++;
  open_.push_back(v);
  frames_.push_back({v});
}

void Reachability::leave(VertexId v) {
  frames_.pop_back();
  if (!frames_.empty()) {
    std::uint32_t& parent = low_[frames_.back().vertex.index()];
    parent = std::min(parent, low_[v.index()]);
  }
  if (low_[v.index()] != order_[v.index()]) return;
  VertexId member;
  do {
    member = open_.back();
    open_.pop_back();
    component_[member.index()] = num_components_;
  } while (member != v);
  ++num_components_;
}

bool Reachability::leads(VertexId from, VertexId to) {
  const std::uint32_t goal = component_[to.index()];
  if (component_[from.index()] <= goal) return component_[from.index()] == goal;
  ++num_searches_;
  std::vector<VertexId> stack{from};
  seen_[from.index()] = num_searches_;
  while (!stack.empty()) {
    const VertexId v = stack.back();
    stack.pop_back();
    for (const EdgeId e : roadmap_.out_edges(v)) {
      const Edge& edge = roadmap_.edge(e);
      const std::uint32_t component = component_[edge.to.index()];
      if (component < goal || !edge.open_to.contains(group_)) continue;
      if (component == goal) return true;
      if (std::exchange(seen_[edge.to.index()], num_searches_) != num_searches_)
        stack.push_back(edge.to);
    }
  }
  return false;
}

}  // namespace quadrille::continuous
