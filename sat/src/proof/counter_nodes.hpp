// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/sat/certificate.hpp"

namespace quadrille::sat {

/// Says in a certificate what variables mean, each before it is used: those of the domain, and
/// those of counters with the numbers ("nodes") that these count.
///
/// What cannot be said is remembered as a fault.
class CounterNodes {
 public:
  /// All outlive it.
  CounterNodes(const ProofLog& log, const ProofMeanings& meanings, int num_variables,
               CertificateWriter& writer);

  void declare(std::span<const Lit> clause);
  /// The node of the root of a sum.
  [[nodiscard]] std::int64_t root(int sum);
  /// The literal "the number exceeds its base by `units` or more", declared. Of a number that
  /// exists, of an agent or a counter, and of units that a search has asked for.
  [[nodiscard]] Lit beyond(const ProofItem& item, Cost units);
  /// The rule by which the clause of a counter holds.
  [[nodiscard]] int rule_of(std::span<const Lit> clause) const;

  /// Empty: none.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  void declare(int variable);
  [[nodiscard]] std::int64_t node(int sum, std::size_t item);
  void write_leaf(std::int64_t node, const ProofItem& item);
  void prepare_leaf(const ProofItem& item);
  [[nodiscard]] std::vector<int> levels_with(const ProofItem& item) const;
  [[nodiscard]] Lit cost_above(AgentId agent, Cost cost);
  void fail(const char* what);

  const ProofLog& log_;
  const ProofMeanings& meanings_;
  CertificateWriter& writer_;
  int num_variables_;
  std::int64_t num_nodes_ = 0;
  std::map<int, std::int64_t> first_node_;             // by sum
  std::map<std::pair<AgentId, Cost>, Lit> new_costs_;  // that the search had no variable for
  std::set<int> declared_;
  std::string fault_;
};

}  // namespace quadrille::sat
