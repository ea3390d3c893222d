// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lazy/domain.hpp"

namespace quadrille::discrete {

/// The theory of the lazy path model of the discrete domain. Agents without a cap are absent.
class LazyTheory final : public lazy::PathTheory<DiscreteDomain> {
 public:
  /// Both outlive the theory.
  LazyTheory(LazyModel& model, LimitMonitor& limits, ExplicitPaths::Price price)
      : PathTheory(limits, model, limits, price) {}

  /// The current path. After a check that added no lemma, those of agents with a cap respect the
  /// caps and the active obstacles.
  [[nodiscard]] const Path& path(AgentId agent) const { return domain_.paths().path(agent); }
  /// The paths that the search had when it paused last, which may collide; before the first pause
  /// those that it has now.
  [[nodiscard]] const Plan& draft();

  /// Called before each solve. Unless all agents will have a cap, only conflicts among those that
  /// have matter: the theory decides for them and ends the solve when they do not collide.
  void on_solve(bool all_present) { is_part_ = !all_present; }

  void on_pause() override { draft_ = domain_.plan(); }
  [[nodiscard]] sat::Lit decide(sat::TheoryContext& context) override;

 private:
  /// A usage of the encounter that is neither allowed nor forbidden yet. No literal if there is
  /// none.
  [[nodiscard]] sat::Lit choose_usage(const Encounter& encounter, FormulaWriter& writer);

  Plan draft_;
  bool is_part_ = false;
};

}  // namespace quadrille::discrete
