// SPDX-License-Identifier: MIT
#include "quadrille/execution/node_order.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

namespace quadrille::execution {
namespace {

using Node = std::uint32_t;

constexpr Node kNone = std::numeric_limits<Node>::max();
constexpr std::size_t kMaxStarts = 64;

/// The moves, and from each to those that wait for its end.
class MoveGraph {
 public:
  explicit MoveGraph(const Precedences& precedences) {
    for (const auto& path : precedences.moves) {
      base_.push_back(static_cast<Node>(ids_.size()));
      for (std::size_t k = 0; k < path.size(); ++k)
        ids_.push_back({AgentId(base_.size() - 1), static_cast<std::uint32_t>(k)});
    }
    // Counted first, then filled in.
    begin_.assign(ids_.size() + 1, 0);
    for_each_edge(precedences, [&](Node from, Node) { ++begin_[from + 1]; });
    for (std::size_t v = 0; v < ids_.size(); ++v) begin_[v + 1] += begin_[v];
    targets_.resize(begin_.back());
    std::vector<std::size_t> at(begin_.begin(), begin_.end() - 1);
    for_each_edge(precedences, [&](Node from, Node to) { targets_[at[from]++] = to; });
  }

  [[nodiscard]] std::size_t size() const { return ids_.size(); }
  [[nodiscard]] const MoveId& id(Node v) const { return ids_[v]; }
  [[nodiscard]] std::span<const Node> after(Node v) const {
    return {targets_.data() + begin_[v], targets_.data() + begin_[v + 1]};
  }

 private:
  template <class Take>
  void for_each_edge(const Precedences& precedences, const Take& take) const {
    for (Node v = 0; v + 1 < ids_.size(); ++v)
      if (ids_[v].agent == ids_[v + 1].agent) take(v, v + 1);
    for (const Precedence& p : precedences.list)
      take(node(p.leader), node(precedences.entry(p.follower)));
  }
  [[nodiscard]] Node node(const MoveId& id) const { return base_[id.agent.index()] + id.move; }

  std::vector<MoveId> ids_;
  std::vector<Node> base_;  // By agent.
  std::vector<std::size_t> begin_;
  std::vector<Node> targets_;
};

/// The knots: strongly connected components of more than one node (there are no loops), by Tarjan's
/// algorithm without recursion.
class Knots {
 public:
  explicit Knots(const MoveGraph& graph)
      : graph_(graph), order_(graph.size(), kNone), low_(graph.size()), knot_(graph.size(), kNone) {
    for (Node v = 0; v < graph.size(); ++v)
      if (order_[v] == kNone) search(v);
  }

  [[nodiscard]] const std::vector<std::vector<Node>>& list() const { return list_; }
  [[nodiscard]] bool are_together(Node v, Node w) const { return knot_[v] == knot_[w]; }

 private:
  struct Frame {
    Node node;
    std::size_t next;
  };

  void search(Node root) {
    enter(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      const Node v = frame.node;
      const auto after = graph_.after(v);
      if (frame.next == after.size()) {
        leave(v);
        continue;
      }
      const Node w = after[frame.next++];
      if (order_[w] == kNone)
        enter(w);
      else if (knot_[w] == kNone)
        low_[v] = std::min(low_[v], order_[w]);
    }
  }
  void enter(Node v) {
    order_[v] = low_[v] = count_++;
    stack_.push_back(v);
    frames_.push_back({v, 0});
  }
  void leave(Node v) {
    frames_.pop_back();
    if (!frames_.empty()) {
      const Node parent = frames_.back().node;
      low_[parent] = std::min(low_[parent], low_[v]);
    }
    if (low_[v] != order_[v]) return;
    std::vector<Node> members;
    do {
      members.push_back(stack_.back());
      knot_[stack_.back()] = num_components_;
      stack_.pop_back();
    } while (members.back() != v);
    ++num_components_;
    std::sort(members.begin(), members.end());
    if (members.size() > 1) list_.push_back(std::move(members));
  }

  const MoveGraph& graph_;
  std::vector<Node> order_, low_, knot_;
  std::vector<Node> stack_;
  std::vector<Frame> frames_;
  std::vector<std::vector<Node>> list_;
  Node count_ = 0, num_components_ = 0;
};

/// A shortest cycle through `start`, which is in a knot.
std::vector<Node> cycle_through(const MoveGraph& graph, const Knots& knots, Node start) {
  std::vector<Node> before(graph.size(), kNone), queue{start};
  for (std::size_t at = 0; at < queue.size(); ++at) {
    const Node v = queue[at];
    for (const Node w : graph.after(v)) {
      if (!knots.are_together(v, w)) continue;
      if (w == start) {
        std::vector<Node> cycle{v};
        while (cycle.back() != start) cycle.push_back(before[cycle.back()]);
        std::reverse(cycle.begin(), cycle.end());
        return cycle;
      }
      if (before[w] != kNone) continue;
      before[w] = v;
      queue.push_back(w);
    }
  }
  return {};
}

}  // namespace

NodeOrder node_order(const Precedences& precedences) {
  NodeOrder result;
  for (const Precedence& p : precedences.list)
    if (precedences.overlaps(p)) ++result.num_overlaps;
  const MoveGraph graph(precedences);
  const Knots knots(graph);
  result.num_knots = knots.list().size();
  if (result.num_knots == 0) return result;
  for (const auto& knot : knots.list()) result.num_knotted_moves += knot.size();
  const auto& smallest =
      *std::min_element(knots.list().begin(), knots.list().end(),
                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<Node> best;
  for (std::size_t k = 0; k < std::min(kMaxStarts, smallest.size()); ++k) {
    std::vector<Node> cycle = cycle_through(graph, knots, smallest[k]);
    if (best.empty() || cycle.size() < best.size()) best = std::move(cycle);
  }
  for (const Node v : best) result.cycle.push_back(graph.id(v));
  return result;
}

}  // namespace quadrille::execution
