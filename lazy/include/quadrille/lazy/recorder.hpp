// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/lazy/vocabulary.hpp"
#include "quadrille/sat/dependence.hpp"
#include "quadrille/sat/lemma.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::lazy {

/// Remembers the lemmas of a search as far as an attribution needs them: who collides, and about
/// whom there are clauses that do not speak of its cost.
class Recorder final : public sat::PassingObserver {
 public:
  /// Both outlive the recorder; `next` may be null.
  Recorder(const Vocabulary& vocabulary, std::size_t num_agents, sat::ClauseObserver* next);

  void on_lemma(const sat::Lemma& lemma) override;

  /// Calls visit(why, usages) for each collision lemma, in their order.
  template <class Visit>
  void for_each_collision(const Visit& visit) const {
    std::size_t begin = 0;
    for (const auto& [why, end] : collisions_) {
      visit(why, std::span<const sat::Usage>(usages_).subspan(begin, end - begin));
      begin = end;
    }
  }
  /// Who depends on whom, by all lemmas so far (docs/soundness/cost.md, 12.1). `has_plan`: a plan
  /// of all agents is known to exist.
  [[nodiscard]] sat::Dependence dependence(bool has_plan) const;

 private:
  [[nodiscard]] bool has_cost_of(AgentId agent, std::span<const sat::Lit> clause) const;

  const Vocabulary& vocabulary_;
  std::vector<std::pair<sat::Why, std::size_t>> collisions_;  // and where their usages end
  std::vector<sat::Usage> usages_;
  IdVector<AgentId, bool> is_unconditional_;
  IdVector<AgentId, bool> has_ceiling_;
};

}  // namespace quadrille::lazy

QUADRILLE_API_END
