// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/sat/dependence.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Remembers the lemmas of a search as far as an attribution needs them: which agents collide
/// where, and about whom there are clauses that do not speak of its cost. Passes everything on to
/// another observer.
class LemmaRecorder final : public sat::ClauseObserver {
 public:
  /// Both outlive the recorder; `next` may be null.
  LemmaRecorder(const Model& model, sat::ClauseObserver* next);

  void on_lemma(const sat::Lemma& lemma) override;
  void on_learned(std::span<const sat::Lit> clause) override;
  void on_core(std::span<const sat::Lit> clause) override;
  [[nodiscard]] bool wants_learned() const override;

  /// Where agents collide, see Attribution::sites. Agents that someone's rest keeps off a goal are
  /// among them, although that takes no collision lemma.
  [[nodiscard]] std::vector<CollisionSite> sites() const;
  /// Who depends on whom, by all lemmas so far. `has_plan`: a plan of all agents is known.
  [[nodiscard]] sat::Dependence dependence(bool has_plan) const;

 private:
  [[nodiscard]] bool has_cost_literal(AgentId agent, std::span<const sat::Lit> clause) const;
  [[nodiscard]] CollisionSite site_of(const Obstacle& one, const Obstacle& other) const;
  /// Where the roads of two moves meet; the second place only if neither is the other's.
  void set_crossing(const Obstacle& one, const Obstacle& other, CollisionSite& site) const;

  const Model& model_;
  sat::ClauseObserver* const next_;
  std::vector<std::pair<ObstacleId, ObstacleId>> collisions_;
  std::vector<std::pair<AgentId, AgentId>> pairs_;  // that were searched together
  IdVector<AgentId, bool> is_unconditional_;
  IdVector<AgentId, bool> must_be_in_time_;  // clauses say that their costs are not too high
};

}  // namespace quadrille::continuous
