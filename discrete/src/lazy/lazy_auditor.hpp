// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lazy/lazy_model.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/sat/clause_auditor.hpp"

namespace quadrille::discrete {

/// Derives the lemmas of the lazy path model again from their usages: path lemmas by a search over
/// the time-expanded graph, collision lemmas by a joint search of the two agents. Slow.
class LazyAuditor final : public sat::ClauseAuditor {
 public:
  /// `model` outlives the auditor. `known_plan` must be a valid plan if given.
  LazyAuditor(const LazyModel& model, bool derive, std::optional<Plan> known_plan);

 private:
  [[nodiscard]] std::string audit(const sat::Lemma& lemma) override;
  [[nodiscard]] std::optional<bool> find_in_plan(sat::Lit lit) const override;
  [[nodiscard]] std::string describe(Clause clause) const override;
  [[nodiscard]] std::string audit_path(const sat::Lemma& lemma, AgentId agent) const;
  [[nodiscard]] std::string audit_collision(const sat::Lemma& lemma) const;
  [[nodiscard]] std::string audit_order(Clause clause) const;
  [[nodiscard]] std::string audit_explicit(Clause clause, AgentId agent) const;
  /// Of the order lemmas that define rests.
  [[nodiscard]] std::string audit_rest(Clause clause) const;
  [[nodiscard]] std::string audit_taken(const sat::Lemma& lemma, VertexId goal) const;
  [[nodiscard]] std::string audit_usages(const sat::Lemma& lemma) const;

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
  [[nodiscard]] bool has_way_home(AgentId agent, const Demand& demand,
                                  std::span<const Visit> elsewhere) const;
  [[nodiscard]] bool has_path_until(Timestep end, AgentId agent, const Demand& demand,
                                    std::optional<VertexId> goal, bool from_then = false) const;
  [[nodiscard]] VertexId explicit_state(AgentId agent, const Path& path, Timestep t) const;
  [[nodiscard]] Timestep rests_from(const LazyModel::Variable& variable, VertexId goal) const;
  /// True if the agents can move from their starts so that they do not collide and each makes all
  /// of its usages. At most four usages.
  [[nodiscard]] bool can_use_all(AgentId a, AgentId b, std::span<const Obstacle> usages) const;

  const LazyModel& model_;
  std::optional<Plan> known_plan_;
};

}  // namespace quadrille::discrete
