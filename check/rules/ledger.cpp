// SPDX-License-Identifier: MIT
#include "rules/ledger.hpp"

#include <algorithm>

namespace quadrille_check {

Ledger::Ledger(const Instance& instance, const Meanings& meanings) : meanings_(meanings) {
  for (const Instance::Agent& agent : instance.agents()) {
    const Int cost = instance.distances(agent.start)[static_cast<std::size_t>(agent.goal)];
    free_costs_.push_back(cost);
    free_sum_ += cost;
    free_makespan_ = std::max(free_makespan_, cost);
  }
  lower_ = free_sum_;
}

void Ledger::close(Int lit) {
  const Variable& x = meanings_.variable(lit);
  if (x.kind == Variable::Kind::costs_at_most) {
    require(lit < 0, "a unit is that an agent costs more");
    require(x.number >= free_costs_[static_cast<std::size_t>(x.agent)],
            "every plan costs so much anyway");
    require(closed_costs_.insert({x.agent, x.number}).second, "a unit was paid for already");
    return;
  }
  require(lit > 0 && x.kind == Variable::Kind::number_is_at_least, "a literal is no unit");
  const auto sum = opened_.find(x.node);
  require(sum != opened_.end() && x.number >= 2 && x.number <= sum->second,
          "a unit of a sum that is not open");
  require(closed_numbers_.insert({x.node, x.number}).second, "a unit was paid for already");
}

void Ledger::pay(const std::vector<Int>& clause, Int node) {
  require(!excess_, "a core comes after the excess was counted");
  require(!clause.empty(), "a core without units");
  for (const Int lit : clause) close(lit);
  ++lower_;
  if (node != -1) open(node, clause);
}

void Ledger::open(Int node, const std::vector<Int>& literals) {
  require(meanings_.node(node).kind == Node::Kind::sum, "a core's counter is a sum");
  std::vector<Int> counted, named = literals;
  for (const Int leaf : meanings_.leaves(node, literals.size())) {
    require(meanings_.node(leaf).kind == Node::Kind::literal, "a core's counter counts literals");
    counted.push_back(meanings_.node(leaf).of);
  }
  std::sort(counted.begin(), counted.end());
  std::sort(named.begin(), named.end());
  require(counted == named, "a core's counter counts something else");
  require(opened_.emplace(node, static_cast<Int>(literals.size())).second,
          "a core's counter was opened before");
}

void Ledger::take(Int node, Int number, std::set<Unit>& taken) const {
  require(opened_.count(node) != 0 && number >= 2 && closed_numbers_.count({node, number}) == 0 &&
              taken.insert({node, number}).second,
          "the excess counts a unit that is not open");
}

void Ledger::take_leaf(const Node& leaf, std::set<Unit>& taken, std::set<Int>& agents) const {
  if (leaf.kind == Node::Kind::agent) {
    require(agents.insert(leaf.of).second, "the excess counts an agent twice");
    require(leaf.base >= free_costs_[static_cast<std::size_t>(leaf.of)],
            "the excess counts what every plan costs anyway");
    const auto closed = closed_costs_.lower_bound({leaf.of, leaf.base});
    require(closed == closed_costs_.end() || closed->first != leaf.of,
            "the excess counts a unit that was paid for");
  } else if (leaf.kind == Node::Kind::beyond) {
    const auto sum = opened_.find(leaf.of);
    require(sum != opened_.end(), "the excess counts a sum that is not open");
    for (Int number = leaf.base + 1; number <= sum->second; ++number) take(leaf.of, number, taken);
  } else {
    require(leaf.kind == Node::Kind::levels, "the excess counts something else");
    for (auto level = static_cast<std::size_t>(leaf.base); level < leaf.levels.size(); ++level)
      take(leaf.levels[level], leaf.rank, taken);
  }
}

void Ledger::count_excess(Int node) {
  require(!excess_, "the excess is counted once");
  std::set<Unit> taken;
  std::set<Int> agents;
  for (const Int leaf : meanings_.leaves(node)) take_leaf(meanings_.node(leaf), taken, agents);
  excess_ = node;
  excess_base_ = lower_;
}

bool Ledger::is_sum_of_delays(Int node) const {
  std::set<Int> agents;
  for (const Int leaf : meanings_.leaves(node)) {
    const Node& n = meanings_.node(leaf);
    if (n.kind != Node::Kind::agent || n.base < free_costs_[static_cast<std::size_t>(n.of)] ||
        !agents.insert(n.of).second)
      return false;
  }
  return true;
}

// 0: nothing.
Int Ledger::bound_of(Int lit, bool is_makespan) const {
  const Variable& x = meanings_.variable(lit);
  Int bound = 0;
  if (x.kind == Variable::Kind::costs_at_most && lit < 0) {
    const Int free_cost = free_costs_[static_cast<std::size_t>(x.agent)];
    bound = is_makespan ? x.number + 1 : free_sum_ + std::max<Int>(0, x.number + 1 - free_cost);
  }
  if (is_makespan) return bound;
  if (excess_)
    if (const Int beyond = meanings_.implied(*excess_, lit); beyond > 0)
      bound = std::max(bound, excess_base_ + beyond);
  if (lit > 0 && x.kind == Variable::Kind::number_is_at_least && is_sum_of_delays(x.node))
    bound = std::max(bound, free_sum_ + x.number);
  return bound;
}

Int Ledger::bound(const std::optional<std::vector<Int>>& clause, bool is_makespan) const {
  if (!clause) return is_makespan ? free_makespan_ : lower_;
  require(!clause->empty(), "that there is no plan at all is no claim of this kind");
  Int least = kEndOfTime * kEndOfTime;
  for (const Int lit : *clause) {
    const Int bound = bound_of(lit, is_makespan);
    require(bound > 0, "a literal of the claim's clause bounds no cost");
    least = std::min(least, bound);
  }
  return least;
}

}  // namespace quadrille_check
