// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lazy/encounter_clauses.hpp"
#include "lazy/explicit_paths.hpp"
#include "lazy/lazy_model.hpp"
#include "lazy/lazy_trail.hpp"
#include "lazy/part_decisions.hpp"
#include "lazy/path_cache.hpp"
#include "lazy/path_search.hpp"
#include "lazy/separation.hpp"
#include "paths/path_index.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/sat/theory.hpp"

namespace quadrille::discrete {

/// Keeps one current path per agent inside the SAT search: the theory of the lazy path model.
///
/// A trail knows each agent's active obstacles and the cap on its cost, as the assignment says. A
/// path that an obstacle hits or that costs more than the cap is replaced by a cheapest one; if
/// there is none within the cap, a path lemma says why. Agents without a cap are *absent*: their
/// paths are left alone and their collisions do not count. On complete assignments all collisions
/// of present agents become clauses at once.
class LazyTheory final : public sat::Theory {
 public:
  /// Both outlive the theory. Plans free paths that avoid each other where that is easy. When a
  /// limit is met the theory ends the solve that it takes part in.
  LazyTheory(LazyModel& model, LimitMonitor& limits, ExplicitPaths::Price price);

  /// The paths of the last complete assignment that was accepted; absent if an agent was.
  [[nodiscard]] const std::optional<Plan>& accepted() const noexcept { return accepted_; }
  /// The current path. After a check that added no lemma, those of agents with a cap respect the
  /// caps and the active obstacles.
  [[nodiscard]] const Path& path(AgentId agent) const { return paths_.path(agent); }
  /// Times that the paths of a complete assignment were checked for collisions.
  [[nodiscard]] std::int64_t num_checks() const noexcept { return num_checks_; }

  /// The paths that the search had when it paused last, which may collide; before the first pause
  /// those that it has now.
  [[nodiscard]] const Plan& draft();
  /// States that path searches have expanded.
  [[nodiscard]] std::int64_t effort() const noexcept override { return search_.effort(); }

  /// Called before each solve. Unless all agents will have a cap, only conflicts among those that
  /// have matter: the theory decides for them and ends the solve when they do not collide.
  void on_solve(bool all_present) { is_part_ = !all_present; }

  void on_assign(std::span<const sat::Lit> newly_true) override;
  void on_retract(std::size_t kept) override;
  void on_pause() override;
  void check(sat::Effort effort, sat::TheoryContext& context) override;
  [[nodiscard]] sat::Lit decide(sat::TheoryContext& context) override;
  sat::Lemma explain(sat::Lit implied, std::vector<sat::Lit>& clause) override;

 private:
  class ContextWriter;

  /// Paths that avoid each other where that is easy.
  void set_free_paths();
  [[nodiscard]] bool is_present(AgentId i) const { return trail_.cap(i) != kForever; }
  /// Replaces violated paths of present agents. False if a lemma says that one has none, or if a
  /// limit was met.
  bool replan_all(ContextWriter& writer);
  bool replan(AgentId i, FormulaWriter& writer);
  /// The remembered path with the fewest collisions that a search could have found as well: within
  /// the cap, around the active obstacles, and so cheap that it leaves no bound to refute. Null if
  /// there is none.
  [[nodiscard]] const Path* find_remembered(AgentId i) const;
  /// Adds "i costs more than `cost`, or one of these usages is allowed", as the search has shown.
  void explain_bound(AgentId i, const PathSearch::Cheapest& search, Timestep cost,
                     FormulaWriter& writer);
  void check_paths(ContextWriter& writer);
  /// A usage of the encounter that is neither allowed nor forbidden yet. No literal if there is
  /// none.
  [[nodiscard]] sat::Lit choose_usage(const Encounter& encounter, FormulaWriter& writer);
  void accept();

  LazyModel& model_;
  LimitMonitor& limits_;
  PathIndex paths_;
  Plan draft_;
  TrailedPaths trailed_paths_;
  LazyTrail trail_;
  PathSearch search_;
  Separation separation_;
  EncounterClauses clauses_;
  ExplicitPaths explicit_paths_;
  PathCache cache_;
  PartDecisions decisions_;
  bool is_part_ = false;

  std::optional<Plan> accepted_;
  std::int64_t num_checks_ = 0;
};

}  // namespace quadrille::discrete
