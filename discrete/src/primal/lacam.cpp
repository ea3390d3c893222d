// SPDX-License-Identifier: MIT
#include "primal/lacam.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "primal/configuration.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

Lacam::Lacam(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
             std::uint32_t seed, std::shared_ptr<const Guide> guide)
    : Lacam(instance, std::move(distances), seed, std::move(guide), false) {}

std::unique_ptr<Lacam> Lacam::guided_locally(const Instance& instance,
                                             std::shared_ptr<const GoalDistances> distances,
                                             std::uint32_t seed) {
  return std::unique_ptr<Lacam>(new Lacam(instance, std::move(distances), seed, nullptr, true));
}

Lacam::Lacam(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
             std::uint32_t seed, std::shared_ptr<const Guide> guide, bool is_local)
    : instance_(instance),
      distances_(std::move(distances)),
      guide_(std::move(guide)),
      random_(seed),
      local_guide_(is_local ? std::make_optional<LocalGuide>(instance_, *distances_, random_)
                            : std::nullopt),
      pibt_(instance_, *distances_, random_,
            is_local ? static_cast<const Guidance*>(&*local_guide_) : guide_.get(),
            Pibt::Ties::least_wanted),
      rank_(instance_.num_agents(), 0) {
  Configuration starts;
  std::vector<AgentId> by_distance;
  const auto far = [&](AgentId agent) {
    return (*distances_)(agent, instance_.agents()[agent].start);
  };
  for (const AgentId agent : instance_.agent_ids()) {
    if (far(agent) == kUnreachable) state_ = State::exhausted;
    starts.push_back(instance_.agents()[agent].start);
    goals_.push_back(instance_.agents()[agent].goal());
    by_distance.push_back(agent);
  }
  if (state_ == State::exhausted) return;
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [&](AgentId a, AgentId b) { return far(a) > far(b); });
  for (std::uint32_t k = 0; k < by_distance.size(); ++k) rank_[by_distance[k].index()] = k;
  visit(std::move(starts), kNone);
}

Lacam::State Lacam::advance(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  while (state_ == State::searching && effort_ < enough && !limits.exhausted()) {
    if (open_.empty()) {
      state_ = State::exhausted;
    } else if (Node& node = nodes_[open_.back()]; node.configuration == goals_) {
      state_ = State::found;
    } else if (node.next_order == node.orders.size()) {
      std::vector<OrderNode>().swap(node.orders);
      node.next_order = 0;
      open_.pop_back();
    } else {
      try_next_order(open_.back());
    }
    effort_ += static_cast<std::int64_t>(goals_.size()) + 1;
  }
  return state_;
}

void Lacam::try_next_order(NodeIndex index) {
  Node& node = nodes_[index];
  const auto order = static_cast<std::uint32_t>(node.next_order++);
  collect_orders(node, order);
  add_suborders(node, order);
  if (local_guide_) {
    const std::int64_t before = local_guide_->effort();
    local_guide_->renew(node.configuration, node.priority);
    effort_ += local_guide_->effort() - before;
  }
  if (pibt_.advance(node.configuration, node.priority, given_, successor_))
    visit(successor_, index);
}

void Lacam::collect_orders(const Node& node, std::uint32_t order) {
  given_.clear();
  for (; node.orders[order].depth > 0; order = node.orders[order].parent) {
    const OrderNode& link = node.orders[order];
    given_.push_back({node.priority[link.depth - 1], link.to});
  }
}

void Lacam::add_suborders(Node& node, std::uint32_t order) {
  const std::uint32_t depth = node.orders[order].depth;
  if (depth == goals_.size()) return;
  const AgentId agent = node.priority[depth];
  const VertexId here = node.configuration[agent.index()];
  std::vector<VertexId> ways(1, here);
  for (const VertexId v : instance_.graph().neighbours(here)) ways.push_back(v);
  random_.shuffle_front(ways, ways.size());
  for (const VertexId to : ways)
    if (!contradicts(node, agent, to)) node.orders.push_back({order, depth + 1, to});
}

/// Whether the order collides with one of those just collected: then no order after it can be
/// obeyed either.
bool Lacam::contradicts(const Node& node, AgentId agent, VertexId to) const {
  const VertexId here = node.configuration[agent.index()];
  return std::any_of(given_.begin(), given_.end(), [&](const Pibt::Order& other) {
    return other.to == to || (other.to == here && node.configuration[other.agent.index()] == to);
  });
}

/// Puts a configuration on top of the stack, as a new node unless it was visited before.
void Lacam::visit(Configuration configuration, NodeIndex parent) {
  const std::uint64_t key = key_of(configuration);
  NodeIndex index = find(key, configuration);
  if (index == kNone) {
    index = static_cast<NodeIndex>(nodes_.size());
    nodes_.push_back({std::move(configuration), parent, {}, {}, {OrderNode()}});
    set_priority(nodes_.back(), parent == kNone ? nullptr : &nodes_[parent]);
    visited_.emplace(key, index);
  }
  open_.push_back(index);
}

/// Agents that have been away from their goal for long go first.
void Lacam::set_priority(Node& node, const Node* parent) {
  const std::size_t agents = goals_.size();
  node.waiting.assign(agents, 0);
  node.priority.clear();
  for (std::size_t i = 0; i < agents; ++i) {
    if (node.configuration[i] != goals_[i])
      node.waiting[i] = parent == nullptr ? 1 : parent->waiting[i] + 1;
    node.priority.push_back(AgentId(i));
  }
  std::sort(node.priority.begin(), node.priority.end(), [&](AgentId a, AgentId b) {
    const auto waiting_a = node.waiting[a.index()], waiting_b = node.waiting[b.index()];
    return waiting_a != waiting_b ? waiting_a > waiting_b : rank_[a.index()] < rank_[b.index()];
  });
}

Lacam::NodeIndex Lacam::find(std::uint64_t key, const Configuration& configuration) const {
  const auto [begin, end] = visited_.equal_range(key);
  const auto same = std::find_if(begin, end, [&](const auto& entry) {
    return nodes_[entry.second].configuration == configuration;
  });
  return same == end ? kNone : same->second;
}

Plan Lacam::plan() const {
  QUADRILLE_REQUIRE(state_ == State::found, "the search has found a plan");
  std::vector<NodeIndex> steps;
  for (NodeIndex k = open_.back(); k != kNone; k = nodes_[k].parent) steps.push_back(k);
  Plan plan;
  plan.paths.resize(goals_.size());
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    for (const AgentId agent : instance_.agent_ids())
      plan.paths[agent].push_back(nodes_[*step].configuration[agent.index()]);
  trim(plan);
  return plan;
}

}  // namespace quadrille::discrete
