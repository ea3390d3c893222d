// SPDX-License-Identifier: MIT
#include "quadrille/sat/totalizer.hpp"

#include <utility>

#include "quadrille/core/contract.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::sat {

Totalizer::Totalizer(Engine& engine, std::size_t num_inputs, Input input)
    : engine_(engine), input_(std::move(input)), num_inputs_(num_inputs) {
  std::vector<std::size_t> layer(num_inputs);
  for (std::size_t i = 0; i < num_inputs; ++i) layer[i] = i;
  while (layer.size() > 1) {
    std::vector<std::size_t> next;
    for (std::size_t i = 0; i + 1 < layer.size(); i += 2) {
      next.push_back(num_inputs_ + adders_.size());
      adders_.push_back({layer[i], layer[i + 1], {}});
    }
    if (layer.size() % 2 == 1) next.push_back(layer.back());
    layer = std::move(next);
  }
  if (engine_.proof() == nullptr) return;
  std::vector<std::pair<std::size_t, std::size_t>> tree;
  for (const Adder& adder : adders_) tree.emplace_back(adder.left, adder.right);
  proof_number_ = engine_.proof()->add_sum(num_inputs_, std::move(tree));
}

Lit Totalizer::output(std::size_t item, int k) const {
  if (item < num_inputs_) return input_(item, k);
  return adders_[item - num_inputs_].sums[static_cast<std::size_t>(k) - 1];
}

void Totalizer::add(std::vector<Lit>& clause) {
  engine_.add_clause({why::Counter{}, clause, {}, false});
}

// Requires that both children know all sums up to k and this adder all up to k-1. Pairs (a, b) with
// a + b > k need no clause for "at least k": some pair below them, which is implied, has sum k.
void Totalizer::grow(std::size_t item, int k) {
  Adder& adder = adders_[item - num_inputs_];
  Lit sum;
  std::vector<Lit> clause;
  for (int a = 0; a <= k; ++a) {
    const Lit left = a > 0 ? output(adder.left, a) : Lit();
    const Lit right = a < k ? output(adder.right, k - a) : Lit();
    if ((a > 0 && !left.valid()) || (a < k && !right.valid())) continue;  // never that large
    if (!sum.valid()) {
      sum = engine_.new_lit();
      if (engine_.proof() != nullptr) engine_.proof()->set_output(proof_number_, item, k, sum);
    }
    clause.clear();
    if (a > 0) clause.push_back(~left);
    if (a < k) clause.push_back(~right);
    clause.push_back(sum);
    add(clause);
  }
  if (sum.valid() && k > 1) {
    clause = {~sum, adder.sums.back()};
    add(clause);
  }
  adder.sums.push_back(sum);
}

Lit Totalizer::at_least(int k) {
  QUADRILLE_REQUIRE(k >= 1, "sums below one need no bound");
  if (num_inputs_ == 0) return {};
  if (adders_.empty()) return input_(0, k);
  for (std::size_t i = 0; i < adders_.size(); ++i)
    while (static_cast<int>(adders_[i].sums.size()) < k)
      grow(num_inputs_ + i, static_cast<int>(adders_[i].sums.size()) + 1);
  return adders_.back().sums[static_cast<std::size_t>(k) - 1];
}

// Only "inputs imply outputs" is encoded, so outputs that are all true fit any inputs. What others
// imply comes first: no clause is false on the way.
void Totalizer::retire() {
  std::vector<Lit> clause(1);
  for (auto adder = adders_.rbegin(); adder != adders_.rend(); ++adder)
    for (const Lit sum : adder->sums) {
      if (!sum.valid()) continue;
      clause[0] = sum;
      add(clause);
    }
}

}  // namespace quadrille::sat
