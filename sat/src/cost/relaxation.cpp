// SPDX-License-Identifier: MIT
#include "cost/relaxation.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {

bool Relaxation::start() {
  if (engine_.proof() != nullptr) proof_pass_ = engine_.proof()->add_pass();
  for (const AgentId i : IdRange<AgentId>(problem_.num_agents())) {
    if (!add({nullptr, 0, i, problem_.free_cost(i)})) return false;
    bound_ += problem_.free_cost(i);
  }
  for (const CostProblem::Fee& fee : problem_.fees())
    if (!add({nullptr, 0, AgentId(), 0, &fee})) return false;
  return true;
}

bool Relaxation::grow(const Soft& soft, Cost units) {
  return soft.counter != nullptr || soft.fee != nullptr ||
         problem_.grow_to(soft.agent, soft.bound + units - 1, limits_);
}

Lit Relaxation::violated_by(const Soft& soft, Cost units) const {
  const Cost least = soft.bound + units;
  if (soft.fee != nullptr) return least <= soft.fee->amount ? soft.fee->due : Lit();
  if (soft.counter == nullptr) return problem_.cost_above(soft.agent, least - 1);
  if (soft.rank == 0) return soft.counter->at_least(1, static_cast<int>(least) + 1);
  return soft.counter->at_least(static_cast<int>(least), soft.rank);
}

bool Relaxation::add(const Soft& soft) {
  if (!grow(soft, 1)) return false;
  if (const Lit lit = violated_by(soft, 1); lit.valid()) softs_.emplace(lit, soft);
  return true;
}

const Relaxation::Soft& Relaxation::soft_of(Lit assumption) const {
  const auto found = softs_.find(~assumption);
  QUADRILLE_REQUIRE(found != softs_.end(), "cores consist of softs");
  return found->second;
}

std::vector<Lit> Relaxation::assumptions() const {
  std::vector<Lit> lits;
  for (const auto& [lit, soft] : softs_) lits.push_back(~lit);
  return lits;
}

std::optional<std::vector<Lit>> Relaxation::raised(std::span<const Lit> core, Cost lift) {
  std::vector<Lit> lits;
  for (const Lit assumption : core) {
    const Soft& soft = soft_of(assumption);
    if (!grow(soft, lift)) return std::nullopt;
    const Lit lit = violated_by(soft, lift);
    lits.push_back(lit.valid() ? ~lit : lit);
  }
  return lits;
}

bool Relaxation::relax(std::span<const Lit> core, Cost lift) {
  std::vector<Lit> violated;
  std::vector<Soft> softs;
  for (const Lit assumption : core) {
    softs.push_back(soft_of(assumption));
    const Lit lit = violated_by(softs.back(), lift);
    if (lit.valid()) violated.push_back(lit);
    softs_.erase(~assumption);
  }
  engine_.add_clause({why::Core{}, violated, {}, false});
  std::vector<AgentId> agents;
  if (keeps_raises_) {
    agents = agents_of(softs);
    raises_.push_back({RaiseKind::core, lift, agents, {}});
  }
  bound_ += lift;
  const int height = static_cast<int>(lift), size = static_cast<int>(softs.size());
  if (size > 1)
    counters_.emplace_back(engine_, height, [this, softs](int level) {
      std::vector<Lit> lits;
      for (const Soft& soft : softs)
        if (const Lit lit = violated_by(soft, level); lit.valid()) lits.push_back(lit);
      return lits;
    });
  note_core(softs, lift, size > 1 ? counters_.back().proof_number() : 0);
  for (Soft soft : softs) {
    soft.bound += lift;
    if (!add(soft)) return false;
  }
  if (size == 1) return true;
  if (keeps_raises_) counted_.emplace(&counters_.back(), std::move(agents));
  if (height == 1) return add({&counters_.back(), 0, AgentId(), 0});
  for (int rank = 2; rank <= size; ++rank)
    if (!add({&counters_.back(), rank, AgentId(), 0})) return false;
  return true;
}

std::vector<AgentId> Relaxation::agents_of(const std::vector<Soft>& softs) const {
  std::vector<AgentId> agents;
  for (const Soft& soft : softs) {
    if (soft.fee != nullptr) continue;
    if (soft.counter == nullptr) {
      agents.push_back(soft.agent);
      continue;
    }
    const std::vector<AgentId>& counted = counted_.at(soft.counter);
    agents.insert(agents.end(), counted.begin(), counted.end());
  }
  std::sort(agents.begin(), agents.end());
  agents.erase(std::unique(agents.begin(), agents.end()), agents.end());
  return agents;
}

Totalizer::Input Relaxation::excess() const {
  std::vector<Soft> items;
  for (const auto& [lit, soft] : softs_) items.push_back(soft);
  return [this, items](std::size_t input, int k) { return violated_by(items[input], k); };
}

ProofItem Relaxation::proof_item(const Soft& soft) {
  QUADRILLE_REQUIRE(soft.fee == nullptr, "certificates know of no fees");
  ProofItem item;
  item.kind = soft.counter == nullptr ? ProofItem::Kind::agent : ProofItem::Kind::counter;
  item.agent = soft.agent;
  item.base = soft.bound;
  item.rank = soft.rank;
  if (soft.counter != nullptr) item.counter = soft.counter->proof_number();
  return item;
}

void Relaxation::note_core(const std::vector<Soft>& softs, Cost lift, int counter) const {
  ProofLog* const proof = engine_.proof();
  if (proof == nullptr) return;
  std::vector<ProofItem> items;
  for (const Soft& soft : softs) items.push_back(proof_item(soft));
  proof->add_core(proof_pass_, counter, lift, std::move(items));
}

void Relaxation::note_excess(int sum) const {
  ProofLog* const proof = engine_.proof();
  if (proof == nullptr) return;
  std::vector<ProofItem> items;
  for (const auto& [lit, soft] : softs_) items.push_back(proof_item(soft));
  proof->set_inputs(sum, std::move(items));
  proof->add_excess(proof_pass_, sum, bound_);
}

void Relaxation::note_bound() const {
  if (engine_.proof() != nullptr) engine_.proof()->claim_by_cores(proof_pass_, bound_);
}

void Relaxation::retire() {
  // Later counters have outputs of earlier ones as inputs.
  for (auto counter = counters_.rbegin(); counter != counters_.rend(); ++counter) counter->retire();
  softs_.clear();
}

}  // namespace quadrille::sat
