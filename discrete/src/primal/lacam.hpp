// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "pibt/pibt.hpp"
#include "primal/guide.hpp"
#include "primal/local_guide.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/primal.hpp"

namespace quadrille::discrete {

/// Depth-first search over configurations (the vertices of all agents at one timestep). The
/// successors of a configuration come one at a time from PIBT, under orders for some agents; the
/// orders of a node are enumerated in a tree of their own, breadth first, from no order at all to
/// one for each agent. So each node yields good successors first and all of them in the end.
///
/// LaCAM (Okumura, "LaCAM: search-based algorithm for quick multi-agent pathfinding", AAAI 2023).
/// Complete: with enough time and memory it finds a plan if there is one. Memory grows by about 12
/// bytes per agent and configuration visited.
class Lacam {
 public:
  using State = PrimalSearch::State;

  /// `instance` outlives the object. `guide` may be null: nothing is guided then.
  Lacam(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
        std::uint32_t seed, std::shared_ptr<const Guide> guide);
  /// Guided by a LocalGuide instead, which is made anew for each configuration. Takes about ten
  /// times the effort. Requires an agent.
  [[nodiscard]] static std::unique_ptr<Lacam> guided_locally(
      const Instance& instance, std::shared_ptr<const GoalDistances> distances, std::uint32_t seed);
  Lacam(const Lacam&) = delete;
  Lacam& operator=(const Lacam&) = delete;

  /// Searches on until `effort` more is spent, a limit is met or the search is over.
  State advance(std::int64_t effort, LimitMonitor& limits);
  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }
  [[nodiscard]] std::size_t num_configurations() const noexcept { return nodes_.size(); }
  /// Trimmed. Requires State::found.
  [[nodiscard]] Plan plan() const;

 private:
  Lacam(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
        std::uint32_t seed, std::shared_ptr<const Guide> guide, bool is_local);

  using NodeIndex = std::uint32_t;
  using Configuration = std::vector<VertexId>;  // By agent.
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// One order: for the agent whose turn is `depth` - 1, on top of those of the parent. The root of
  /// a tree, with depth 0, orders nothing.
  struct OrderNode {
    std::uint32_t parent = kNone;
    std::uint32_t depth = 0;
    VertexId to;
  };
  struct Node {
    Configuration configuration;
    NodeIndex parent;
    std::vector<std::uint32_t> waiting;  // By agent: steps since it was at its goal.
    std::vector<AgentId> priority;       // In this order agents choose and get orders.
    std::vector<OrderNode> orders;
    std::size_t next_order = 0;  // Those before it were tried.
  };

  void try_next_order(NodeIndex index);
  void add_suborders(Node& node, std::uint32_t order);
  void collect_orders(const Node& node, std::uint32_t order);
  [[nodiscard]] bool contradicts(const Node& node, AgentId agent, VertexId to) const;
  void visit(Configuration configuration, NodeIndex parent);
  void set_priority(Node& node, const Node* parent);
  [[nodiscard]] NodeIndex find(std::uint64_t key, const Configuration& configuration) const;

  const Instance& instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  const std::shared_ptr<const Guide> guide_;
  Random random_;
  std::optional<LocalGuide> local_guide_;
  Pibt pibt_;
  Configuration goals_;
  std::vector<std::uint32_t> rank_;  // By agent: position when sorted by distance, far ones first.
  std::deque<Node> nodes_;
  std::unordered_multimap<std::uint64_t, NodeIndex> visited_;  // Only looked up, never walked.
  std::vector<NodeIndex> open_;                                // A stack.
  std::vector<Pibt::Order> given_;
  Configuration successor_;
  State state_ = State::searching;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::discrete
