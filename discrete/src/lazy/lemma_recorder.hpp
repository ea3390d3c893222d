// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lazy/lazy_model.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/sat/dependence.hpp"

namespace quadrille::discrete {

/// Remembers the lemmas of the lazy model as far as an attribution needs them: which agents collide
/// where, and who has explicit paths. Passes everything on to another observer.
class LemmaRecorder final : public sat::ClauseObserver {
 public:
  /// Both outlive the recorder; `next` may be null.
  LemmaRecorder(const LazyModel& model, sat::ClauseObserver* next);

  void on_lemma(const sat::Lemma& lemma) override;
  void on_learned(std::span<const sat::Lit> clause) override;
  void on_core(std::span<const sat::Lit> clause) override;
  [[nodiscard]] bool wants_learned() const override;

  /// Where agents collide, see Attribution::sites. Agents that someone's rest keeps off a goal are
  /// among them, although that takes no collision lemma.
  [[nodiscard]] std::vector<CollisionSite> sites() const;
  /// Who depends on whom, by all lemmas so far. Requires that the instance has a plan.
  [[nodiscard]] sat::Dependence dependence() const;

 private:
  /// The obstacles that one collision lemma excludes together.
  using Usages = std::span<const ObstacleId>;
  [[nodiscard]] CollisionSite site_of(Usages usages) const;
  template <class Visit>
  void for_each_lemma(const Visit& visit) const;
  /// The first one that is not of the first one's agent.
  [[nodiscard]] std::optional<ObstacleId> other_of(Usages usages) const;
  /// The agent whose goal the obstacle keeps others off; nothing for other obstacles.
  [[nodiscard]] std::optional<AgentId> resident_of(const Obstacle& obstacle) const;

  const LazyModel& model_;
  sat::ClauseObserver* const next_;
  std::vector<ObstacleId> usages_;  // of all collision lemmas
  std::vector<std::size_t> ends_;   // of each one's
  IdVector<AgentId, bool> is_explicit_;
};

}  // namespace quadrille::discrete
