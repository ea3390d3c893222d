// SPDX-License-Identifier: MIT
#include "cover/cover_tree.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <utility>

#include "cover/leaf_program.hpp"

namespace quadrille::continuous {
namespace {

using Multipliers = std::vector<std::pair<std::size_t, Cost>>;
__extension__ using Wide = __int128;

class TreeMaker {
 public:
  TreeMaker(const IdVector<AgentId, Cost>& free_costs, std::span<const LevelCore> cores,
            Cost wanted)
      : free_costs_(free_costs), cores_(cores), wanted_(wanted), program_(free_costs) {
    std::vector<const LevelCore*> list;
    for (const LevelCore& core : cores) list.push_back(&core);
    table_ = CoreTable(list);
    program_.set_cores(table_);
  }

  CoverTree run(std::size_t most_leaves) {
    nodes_.emplace_back();
    relax(0);
    push(0);
    std::size_t num_leaves = 1;
    while (num_leaves < most_leaves && open_.top().first < wanted_) {
      const std::size_t at = open_.top().second;
      if (!nodes_[at].leaf.branch) break;
      open_.pop();
      divide(at);
      ++num_leaves;
    }
    CoverTree tree;
    tree.bound = open_.top().first;
    write(0, tree);
    return tree;
  }

 private:
  struct Node {
    CoverLeaf leaf;
    Multipliers multipliers;
    Cost bound = 0;
    std::size_t below = 0;  // the next one is its sibling; 0: a leaf
  };

  void push(std::size_t at) { open_.emplace(nodes_[at].bound, at); }

  void divide(std::size_t at) {
    auto parts = split(nodes_[at].leaf);
    const Multipliers inherited = nodes_[at].multipliers;
    const Level level = *nodes_[at].leaf.branch;
    nodes_[at].below = nodes_.size();
    nodes_[at].leaf = CoverLeaf();
    nodes_[at].leaf.branch = level;
    for (CoverLeaf* part : {&parts.first, &parts.second}) {
      nodes_.emplace_back();
      nodes_.back().leaf = std::move(*part);
      nodes_.back().multipliers = inherited;
      relax(nodes_.size() - 1);
      push(nodes_.size() - 1);
    }
  }

  /// The best multipliers that are known: those of the part before, none, and those of the leaf's
  /// linear program.
  void relax(std::size_t at) {
    Node& node = nodes_[at];
    node.bound = bound_of(node.leaf, node.multipliers);
    offer(node, {});
    IdVector<AgentId, Cost> costs;
    if (!program_.solve(node.leaf, costs)) {
      offer(node, {{core_out_of_reach(node.leaf), wanted_ * CoverTree::kFraction}});
      node.leaf.branch.reset();
      return;
    }
    offer(node, program_.core_units());
    if (node.bound >= wanted_) return;
    program_.refine(node.leaf, wanted_);
    offer(node, program_.core_units());
  }

  void offer(Node& node, Multipliers multipliers) const {
    const Cost bound = bound_of(node.leaf, multipliers);
    if (bound <= node.bound) return;
    node.bound = bound;
    node.multipliers = std::move(multipliers);
  }

  [[nodiscard]] static CoverLeaf::Range range_of(const CoverLeaf& leaf, AgentId i) {
    for (const CoverLeaf::Range& range : leaf.ranges)
      if (range.agent == i) return range;
    return {i};
  }

  /// Of a leaf without solution.
  [[nodiscard]] std::size_t core_out_of_reach(const CoverLeaf& leaf) const {
    const auto is_in_reach = [&](const Level& level) {
      return level.cost < range_of(leaf, level.agent).high;
    };
    const auto at = std::find_if(cores_.begin(), cores_.end(), [&](const LevelCore& core) {
      return std::none_of(core.begin(), core.end(), is_in_reach);
    });
    return static_cast<std::size_t>(at - cores_.begin());
  }

  /// The Lagrangian bound, rounded up.
  [[nodiscard]] Cost bound_of(const CoverLeaf& leaf, const Multipliers& multipliers) const {
    std::map<Level, Wide> gains;
    Wide sum = 0;
    for (const auto& [core, units] : multipliers) {
      sum += units;
      for (const Level& level : cores_[core]) gains[level] += units;
    }
    for (const CoverLeaf::Range& range : leaf.ranges) gains[{range.agent, 0}] += 0;
    for (auto at = gains.begin(); at != gains.end();) {
      const AgentId i = at->first.agent;
      const CoverLeaf::Range range = range_of(leaf, i);
      const Cost low = std::max(range.low, free_costs_[i]);
      Wide gain = 0;
      for (; at != gains.end() && at->first.agent == i && at->first.cost <= low; ++at)
        gain += at->second;
      Wide least = paid(i, low) - gain;
      for (; at != gains.end() && at->first.agent == i; ++at) {
        if (at->first.cost >= range.high) continue;
        gain += at->second;
        least = std::min(least, paid(i, at->first.cost) - gain);
      }
      sum += least;
    }
    return sum <= 0 ? 0
                    : static_cast<Cost>((sum + CoverTree::kFraction - 1) / CoverTree::kFraction);
  }
  [[nodiscard]] Wide paid(AgentId i, Cost cost) const {
    return static_cast<Wide>(cost - free_costs_[i]) * CoverTree::kFraction;
  }

  void write(std::size_t at, CoverTree& tree) const {
    const Node& node = nodes_[at];
    if (node.below == 0) {
      tree.nodes.push_back({std::nullopt, node.multipliers});
      return;
    }
    tree.nodes.push_back({node.leaf.branch, {}});
    write(node.below, tree);
    write(node.below + 1, tree);
  }

  const IdVector<AgentId, Cost>& free_costs_;
  const std::span<const LevelCore> cores_;
  const Cost wanted_;
  CoreTable table_;
  LeafProgram program_;
  std::vector<Node> nodes_;
  using Open = std::pair<Cost, std::size_t>;  // bound, node
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

}  // namespace

CoverTree make_cover_tree(const IdVector<AgentId, Cost>& free_costs,
                          std::span<const LevelCore> cores, Cost wanted, std::size_t most_leaves) {
  return TreeMaker(free_costs, cores, wanted).run(most_leaves);
}

}  // namespace quadrille::continuous
