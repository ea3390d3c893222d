// SPDX-License-Identifier: MIT
#include "proof/counter_nodes.hpp"

#include <algorithm>

namespace quadrille::sat {

CounterNodes::CounterNodes(const ProofLog& log, const ProofMeanings& meanings, int num_variables,
                           CertificateWriter& writer)
    : log_(log), meanings_(meanings), writer_(writer), num_variables_(num_variables) {}

void CounterNodes::fail(const char* what) {
  if (fault_.empty()) fault_ = what;
}

void CounterNodes::declare(std::span<const Lit> clause) {
  for (const Lit lit : clause) declare(lit.variable());
}

void CounterNodes::declare(int variable) {
  if (!declared_.insert(variable).second) return;
  if (const ProofLog::Output* output = log_.output_of(variable)) {
    const std::int64_t of = node(output->sum, output->item);
    writer_.record('s', {variable, of, output->k});
  } else if (!meanings_.declare(variable, writer_)) {
    fail("a variable without a meaning is needed");
  }
}

std::int64_t CounterNodes::root(int sum) { return node(sum, log_.sum(sum).root()); }

// The nodes of a sum have consecutive numbers, in the order of its items. Those that its inputs are
// made of come first.
std::int64_t CounterNodes::node(int sum, std::size_t item) {
  const auto known = first_node_.find(sum);
  if (known != first_node_.end()) return known->second + static_cast<std::int64_t>(item);
  const ProofLog::Sum& tree = log_.sum(sum);
  if (tree.inputs.size() != tree.num_inputs) {
    fail("a counter without inputs is needed");
    return 0;
  }
  for (const ProofItem& input : tree.inputs) prepare_leaf(input);
  const std::int64_t first = num_nodes_;
  first_node_[sum] = first;
  num_nodes_ += static_cast<std::int64_t>(tree.num_inputs + tree.adders.size());
  for (std::size_t at = 0; at < tree.num_inputs; ++at)
    write_leaf(first + static_cast<std::int64_t>(at), tree.inputs[at]);
  std::int64_t adder = first + static_cast<std::int64_t>(tree.num_inputs);
  for (const auto& [left, right] : tree.adders)
    writer_.record('n', {adder++, 3, first + static_cast<std::int64_t>(left),
                         first + static_cast<std::int64_t>(right)});
  return first + static_cast<std::int64_t>(item);
}

/// The levels in which `rank` numbers can be counted: all up to one.
std::vector<int> CounterNodes::levels_with(const ProofItem& item) const {
  std::vector<int> sums;
  for (const int sum : log_.levels(item.counter)) {
    if (log_.sum(sum).num_inputs < static_cast<std::size_t>(std::max(item.rank, 2))) break;
    sums.push_back(sum);
    if (item.rank == 0) break;
  }
  return sums;
}

void CounterNodes::prepare_leaf(const ProofItem& item) {
  if (item.kind == ProofItem::Kind::literal) declare(item.literal.variable());
  if (item.kind != ProofItem::Kind::counter) return;
  for (const int sum : levels_with(item)) static_cast<void>(root(sum));
}

void CounterNodes::write_leaf(std::int64_t number, const ProofItem& item) {
  if (item.kind == ProofItem::Kind::literal)
    return writer_.record('n', {number, 0, writer_.number(item.literal)});
  if (item.kind == ProofItem::Kind::agent)
    return writer_.record('n',
                          {number, 1, static_cast<std::int64_t>(item.agent.value()), item.base});
  const std::vector<int> sums = levels_with(item);
  if (sums.empty()) return fail("a counter that counts nothing is needed");
  if (item.rank == 0)  // of all numbers but the largest
    return writer_.record('n', {number, 2, root(sums.front()), item.base + 1});
  std::vector<std::int64_t> values{number, 4, item.rank, item.base};
  for (const int sum : sums) values.push_back(root(sum));
  writer_.record('n', values);
}

Lit CounterNodes::cost_above(AgentId agent, Cost cost) {
  if (const Lit known = meanings_.cost_above(agent, cost); known.valid()) return known;
  const auto [made, is_new] = new_costs_.try_emplace({agent, cost});
  if (is_new) {
    const int variable = ++num_variables_;
    ProofMeanings::declare_cost(variable, agent, cost, writer_);
    declared_.insert(variable);
    made->second = ~Lit::from_dimacs(variable);
  }
  return made->second;
}

Lit CounterNodes::beyond(const ProofItem& item, Cost units) {
  const Cost least = item.base + units;
  Lit lit;
  if (item.kind == ProofItem::Kind::agent) {
    lit = cost_above(item.agent, least - 1);
  } else {
    const std::vector<int>& levels = log_.levels(item.counter);
    const auto level = static_cast<std::size_t>(item.rank == 0 ? 1 : least);
    if (level > levels.size()) return {};
    const int sum = levels[level - 1];
    const auto count = item.rank == 0 ? static_cast<int>(least) + 1 : item.rank;
    lit = log_.find_output(sum, log_.sum(sum).root(), count);
  }
  if (lit.valid()) declare(lit.variable());
  return lit;
}

int CounterNodes::rule_of(std::span<const Lit> clause) const {
  constexpr int kSum = 6, kLevels = 7;
  if (clause.size() == 1) return 0;  // of a counter that was retired
  if (clause.size() != 2) return kSum;
  const ProofLog::Output* first = log_.output_of(clause[0].variable());
  const ProofLog::Output* second = log_.output_of(clause[1].variable());
  const bool is_of_levels =
      first != nullptr && second != nullptr && clause[0].positive() != clause[1].positive() &&
      log_.counter_of(first->sum) != 0 &&
      log_.counter_of(first->sum) == log_.counter_of(second->sum) && first->sum != second->sum;
  return is_of_levels ? kLevels : kSum;
}

}  // namespace quadrille::sat
