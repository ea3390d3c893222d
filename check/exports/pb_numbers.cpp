// SPDX-License-Identifier: MIT
#include "exports/pb_numbers.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace quadrille_check {
namespace {

/// More than any factor, so that a division by it leaves a clause.
constexpr Int kMoreThanAll = 1'000'000'000;
constexpr std::size_t kMostTerms = 20'000'000;

std::string name(Int lit) { return (lit < 0 ? "~x" : "x") + std::to_string(std::abs(lit)); }

}  // namespace

PbSum& PbSum::push(const std::string& operand) {
  const bool is_first = text_.empty();
  text_ += ' ' + operand;
  if (!is_first) text_ += " +";
  return *this;
}
PbSum& PbSum::add(Int constraint, Int factor) {
  const std::string number = std::to_string(constraint);
  return push(factor == 1 ? number : number + ' ' + std::to_string(factor) + " *");
}
PbSum& PbSum::add_literal(Int lit) { return push(name(lit)); }
PbSum& PbSum::resolve(Int clause) {
  add(clause);
  text_ += " s";
  return *this;
}
PbSum& PbSum::divide(Int by) {
  text_ += ' ' + std::to_string(by) + " d";
  return *this;
}
PbSum& PbSum::as_clause() { return divide(kMoreThanAll); }

void PbProof::put(std::string& text, Int factor, Int lit) {
  if (++num_terms_ > kMostTerms) throw BadInput("the export would be too long");
  text += std::to_string(factor) + ' ' + name(lit) + ' ';
}

void PbProof::put(std::string& text, std::span<const Int> literals, Int sign) {
  for (const Int lit : literals) put(text, 1, sign * lit);
}

Int PbProof::given(std::span<const Int> literals, Int degree) {
  put(formula_, literals, 1);
  formula_ += ">= " + std::to_string(degree) + " ;\n";
  ++num_given_;
  return ++num_constraints_;
}

Int PbProof::derive(const PbSum& sum) {
  num_terms_ += sum.text().size() / 8;
  if (num_terms_ > kMostTerms) throw BadInput("the export would be too long");
  steps_ += "pol" + sum.text() + '\n';
  return ++num_constraints_;
}

Int PbProof::define(Int variable, std::span<const Int> literals, Int k) {
  const auto step = [&](Int factor, Int lit, Int sign) {
    steps_ += "red ";
    put(steps_, factor, lit);
    put(steps_, literals, sign);
    steps_ +=
        ">= " + std::to_string(factor) + " ; " + name(variable) + (lit > 0 ? " -> 1\n" : " -> 0\n");
    ++num_constraints_;
  };
  const Int others = static_cast<Int>(literals.size()) - k + 1;
  if (others > 0) step(others, variable, -1);
  step(k, -variable, 1);
  return num_constraints_;
}

std::string PbProof::formula() const {
  return "* #variable= " + std::to_string(num_variables_) +
         " #constraint= " + std::to_string(num_given_) + '\n' + formula_;
}
std::string PbProof::refutation(Int contradiction) const {
  return "pseudo-Boolean proof version 2.0\nf " + std::to_string(num_given_) + '\n' + steps_ +
         "output NONE\nconclusion UNSAT : " + std::to_string(contradiction) +
         "\nend pseudo-Boolean proof\n";
}

// ---- numbers ------------------------------------------------------------------------------------

void PbNumbers::note(const Record& record) {
  const Ints& values = record.values;
  if (record.tag == 'n') {
    if (values[1] == static_cast<Int>(Node::Kind::agent)) fill(values[2], values[3]);
    return;
  }
  const bool is_cost = record.tag == 'c';
  Int& known = is_cost ? costs_[values[1]][values[2]] : numbers_[{values[1], values[2]}];
  if (known == 0) known = values[0];
  same_[values[0]] = known;
  meant_[known] = {values[1], values[2]};
  if (is_cost) return;
  Int& largest = largest_[values[1]];
  largest = std::max(largest, values[2]);
}

void PbNumbers::fill(Int agent, Int least) {
  const auto lowest = fills_.emplace(agent, least).first;
  lowest->second = std::min(lowest->second, least);
}

void PbNumbers::give_orders() {
  for (const auto& [agent, least] : fills_) {
    auto& costs = costs_[agent];
    const Int most = costs.empty() ? least : costs.rbegin()->first;
    for (Int cost = least; cost < most; ++cost) {
      if (Int& variable = costs[cost]; variable == 0) variable = proof_.new_variable();
      meant_[costs[cost]] = {agent, cost};
    }
  }
  for (const auto& [agent, costs] : costs_)
    for (auto low = costs.begin(); low != costs.end(); ++low) {
      const auto high = std::next(low);
      if (high == costs.end()) break;
      const Ints clause{high->second, -low->second};
      implications_[{-high->second, -low->second}] = proof_.given(clause, 1);
    }
}

Int PbNumbers::same(Int lit) const {
  const auto known = same_.find(std::abs(lit));
  if (known == same_.end()) return lit;
  return lit > 0 ? known->second : -known->second;
}

const PbNumbers::Definition& PbNumbers::definition(Int node, Int k) {
  const std::pair key{node, k};
  if (const auto known = definitions_.find(key); known != definitions_.end()) return known->second;
  const Ints& counted = terms(node);
  Int& variable = numbers_[key];
  if (variable == 0) {
    variable = proof_.new_variable();
    meant_[variable] = key;
  }
  return definitions_[key] = {variable, proof_.define(variable, counted, k)};
}
Int PbNumbers::at_least(Int node, Int k) { return definition(node, k).variable; }
Int PbNumbers::only_if(Int node, Int k) { return definition(node, k).only_if; }

const Ints& PbNumbers::terms(Int node) {
  if (const auto known = terms_.find(node); known != terms_.end()) return known->second;
  const Node& n = meanings_.node(node);
  Ints made;
  switch (n.kind) {
    case Node::Kind::literal:
      made.push_back(same(n.of));
      break;
    case Node::Kind::agent:
      for (const auto& [cost, variable] : costs_[n.of])
        if (cost >= n.base) made.push_back(-variable);
      break;
    case Node::Kind::beyond:
      for (Int k = n.base + 1; k <= largest_[n.of]; ++k) made.push_back(at_least(n.of, k));
      break;
    case Node::Kind::levels:
      for (auto level = static_cast<std::size_t>(n.base); level < n.levels.size(); ++level)
        made.push_back(at_least(n.levels[level], n.rank));
      break;
    case Node::Kind::sum:
      for (const Int leaf : meanings_.leaves(node)) {
        const Ints& part = terms(leaf);
        made.insert(made.end(), part.begin(), part.end());
      }
  }
  return terms_[node] = std::move(made);
}

void PbNumbers::add_implied(PbSum& sum, Int node, Int lit) {
  const Node& n = meanings_.node(node);
  const Int implied = lit == 0 ? 0 : meanings_.implied(node, lit);
  if (n.kind == Node::Kind::sum && implied > 0) {
    sum.add(only_if(node, implied));
    return;
  }
  const Ints counted = terms(node);
  for (std::size_t k = 0; k < counted.size(); ++k) {
    if (static_cast<Int>(k) >= implied)
      sum.add_literal(counted[k]);
    else if (counted[k] != same(lit))
      sum.add(implication(lit, counted[k]));
  }
}

bool PbNumbers::add_if(PbSum& sum, Int node, Int k) {
  const Ints counted = terms(node);
  const bool can_be = k <= static_cast<Int>(counted.size());
  if (can_be) {
    sum.add(only_if(node, k) - 1);
  } else {
    for (const Int term : counted) sum.add_literal(-term);
  }
  return can_be;
}

Int PbNumbers::implication(Int lit, Int other) {
  lit = same(lit);
  other = same(other);
  const auto known = implications_.find({lit, other});
  if (known != implications_.end()) return known->second;
  const Int made = lit < 0 ? order_of_costs(lit, other) : order_of_numbers(lit, other);
  return implications_[{lit, other}] = made;
}

/// From a cost to the next lower one, from there to the next, and so on.
Int PbNumbers::order_of_costs(Int lit, Int other) {
  const auto& costs = costs_.at(meant_.at(-lit).first);
  auto at = costs.find(meant_.at(-lit).second);
  Int low = -std::prev(at)->second, made = implications_.at({lit, low});
  for (--at; low != other; --at) {
    const Int next = -std::prev(at)->second;
    Int& known = implications_[{lit, next}];
    if (known == 0) known = proof_.derive(PbSum().add(made).resolve(implications_.at({low, next})));
    made = known;
    low = next;
  }
  return made;
}

/// Each literal that the one number counts implies one that the other counts, as in
/// Meanings::is_at_most.
Int PbNumbers::order_of_numbers(Int lit, Int other) {
  const auto [node, number] = meant_.at(lit);
  const auto [bound, least] = meant_.at(other);
  PbSum sum;
  sum.add(only_if(node, number));
  const bool can_be = add_if(sum, bound, least);
  if (node != bound) {
    const Ints left = terms(node), right = terms(bound);
    std::size_t at = 0;
    for (const Int counted : left) {
      for (; !meanings_.implies(counted, right.at(at)); ++at) sum.add_literal(right[at]);
      if (counted != right[at]) sum.add(implication(counted, right[at]));
      ++at;
    }
    for (; at < right.size(); ++at) sum.add_literal(right[at]);
  }
  sum.as_clause();
  if (!can_be) sum.add_literal(other);
  return proof_.derive(sum);
}

}  // namespace quadrille_check
