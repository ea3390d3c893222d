// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lazy/lazy_model.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/sat/lemma.hpp"

namespace quadrille::discrete {

/// Checks while the solver runs that no clause of the lazy path model excludes a plan.
///
/// Every lemma is derived again from its usages: path lemmas by a search over the time-expanded
/// graph, collision lemmas by a joint search of the two agents. With a known plan, every lemma and
/// every learned clause has to be true in it. Keeps the first complaint. Slow.
class LazyAuditor final : public sat::ClauseObserver {
 public:
  /// `model` outlives the auditor. `known_plan` must be a valid plan if given.
  LazyAuditor(const LazyModel& model, bool derive, std::optional<Plan> known_plan);

  void on_lemma(const sat::Lemma& lemma) override;
  void on_learned(std::span<const sat::Lit> clause) override;

  [[nodiscard]] const std::optional<std::string>& complaint() const noexcept { return complaint_; }

 private:
  using Clause = std::span<const sat::Lit>;
  /// Each returns what is wrong, empty if nothing is.
  [[nodiscard]] std::string audit_path(const sat::Lemma& lemma) const;
  /// Of the clauses about explicit paths.
  [[nodiscard]] std::string audit_explicit(Clause clause, AgentId agent) const;
  [[nodiscard]] std::string audit_collision(const sat::Lemma& lemma) const;
  [[nodiscard]] std::string audit_order(Clause clause) const;
  [[nodiscard]] std::string audit_usages(const sat::Lemma& lemma) const;
  [[nodiscard]] std::string audit_against_plan(const sat::Lemma* lemma, Clause clause);

  [[nodiscard]] bool forbids_visit(const Obstacle& obstacle, VertexId v, Timestep t) const;
  [[nodiscard]] bool forbids_move(const Obstacle& obstacle, VertexId v, VertexId w,
                                  Timestep t) const;
  /// What a path has to do and to avoid.
  struct Demand {
    std::vector<Obstacle> avoided;
    std::vector<Visit> visits;
    std::optional<Timestep> bound;  // on the cost; absent: only what comes until the horizon
    Timestep horizon = 0;
  };
  [[nodiscard]] bool has_path(AgentId agent, const Demand& demand) const;
  /// True if the agents can move from their starts so that they do not collide and each makes all
  /// of its usages. At most four usages.
  [[nodiscard]] bool can_use_all(AgentId a, AgentId b, std::span<const Obstacle> usages) const;
  [[nodiscard]] bool is_true_in_plan(sat::Lit lit) const;
  [[nodiscard]] std::string describe(Clause clause) const;
  void complain(const std::string& what, Clause clause);

  const LazyModel& model_;
  bool derive_;
  std::optional<Plan> known_plan_;
  std::vector<bool> counter_is_true_;  // auxiliary variables that the known plan implies
  std::optional<std::string> complaint_;
};

}  // namespace quadrille::discrete
