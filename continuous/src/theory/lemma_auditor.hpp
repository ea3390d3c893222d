// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/sat/clause_auditor.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Derives lemmas again from their usages while the solver runs, by other means than those that
/// found them: path lemmas by a search of its own, which looks at bans one by one; collision lemmas
/// by asking the geometry whether extreme starts collide, never for intervals; lemmas of pairs by a
/// joint search of the two agents tick by tick, if that takes few states. Slow.
class LemmaAuditor final : public sat::ClauseAuditor {
 public:
  /// `model` outlives the auditor. `known_plan` must be a valid plan if given.
  LemmaAuditor(const Model& model, bool derive, const std::optional<Plan>& known_plan);

  /// Lemmas that were derived again.
  [[nodiscard]] std::int64_t num_derived() const noexcept { return num_derived_; }
  /// Lemmas of pairs that would have taken too many states.
  [[nodiscard]] std::int64_t num_skipped() const noexcept { return num_skipped_; }

 private:
  [[nodiscard]] std::string audit(const sat::Lemma& lemma) override;
  [[nodiscard]] std::optional<bool> find_in_plan(sat::Lit lit) const override;
  [[nodiscard]] std::string describe(Clause clause) const override;
  [[nodiscard]] std::string audit_path(const sat::Lemma& lemma, AgentId i) const;
  [[nodiscard]] std::string audit_collision(const sat::Lemma& lemma) const;
  [[nodiscard]] std::string audit_pair(const sat::Lemma& lemma);
  [[nodiscard]] std::string audit_order(const sat::Lemma& lemma) const;
  /// Whether the literals of the usages say what their bans say, and whether the clause has them.
  [[nodiscard]] std::string audit_usages(const sat::Lemma& lemma) const;
  /// Whether nobody can do what these bans forbid while `resident` stays at `goal` for good and
  /// arrived there before `tick`.
  [[nodiscard]] std::string audit_goal_bans(const Obstacle& obstacle, AgentId resident,
                                            VertexId goal, Ticks tick) const;
  [[nodiscard]] std::string audit_rest(const sat::Lemma& lemma) const;
  [[nodiscard]] std::string audit_taken(const sat::Lemma& lemma, VertexId goal) const;

  [[nodiscard]] const Obstacle& obstacle(const sat::Usage& usage) const {
    return model_.obstacles()[ObstacleId(static_cast<std::size_t>(usage.resource))];
  }
  /// Whether all that breaks `a`, by agent i, collides with all that breaks `b`, by j.
  [[nodiscard]] bool all_collide(AgentId i, const Ban& a, AgentId j, const Ban& b) const;
  /// Whether i's move from `start` on collides with a stay of j at `place`.
  [[nodiscard]] bool collides(AgentId i, EdgeId e, Ticks start, AgentId j, VertexId place,
                              Ticks arrive, Ticks leave) const;
  /// Two that stand there collide.
  [[nodiscard]] bool overlap(AgentId i, VertexId v, AgentId j, VertexId w) const;
  [[nodiscard]] ShapePairs bodies(AgentId i, AgentId j) const;
  [[nodiscard]] ShapePairs::Move move(AgentId i, std::uint32_t edge) const;
  [[nodiscard]] ShapePairs::Stand stand(VertexId v) const;

  const Model& model_;
  // Of the known plan; empty without one.
  IdVector<AgentId, TimedPath> paths_;
  IdVector<AgentId, PathUses> uses_;
  std::int64_t num_derived_ = 0, num_skipped_ = 0;
};

}  // namespace quadrille::continuous
