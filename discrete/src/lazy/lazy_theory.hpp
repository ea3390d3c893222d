// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lazy/encounter_clauses.hpp"
#include "lazy/explanation.hpp"
#include "lazy/explicit_paths.hpp"
#include "lazy/lazy_model.hpp"
#include "lazy/path_cache.hpp"
#include "lazy/path_finder.hpp"
#include "lazy/path_index.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/sat/theory.hpp"

namespace quadrille::discrete {

/// Keeps one current path per agent inside the SAT search: the theory of the lazy path model.
///
/// Each agent has a stack of active obstacles and a cap on its cost, as the assignment says, and a
/// path. A path that an obstacle hits or that is dearer than the cap is replaced by a cheapest one;
/// if there is none within the cap, a path lemma says why. Agents without a cap are *absent*: their
/// paths are left alone and their collisions do not count. On complete assignments all collisions
/// of present agents become clauses at once.
class LazyTheory final : public sat::Theory {
 public:
  /// Both outlive the theory. Plans free paths that avoid each other where that is easy. When a
  /// limit is met the theory ends the solve that it takes part in.
  LazyTheory(LazyModel& model, LimitMonitor& limits);

  /// The paths of the last complete assignment that was accepted; absent if an agent was.
  [[nodiscard]] const std::optional<Plan>& accepted() const noexcept { return accepted_; }
  /// The current path. After a check that added no lemma, those of agents with a cap respect the
  /// caps and the active obstacles.
  [[nodiscard]] const Path& path(AgentId agent) const { return paths_.path(agent); }
  /// Times that the paths of a complete assignment were checked for collisions.
  [[nodiscard]] std::int64_t num_checks() const noexcept { return num_checks_; }

  /// States that path searches have expanded.
  [[nodiscard]] std::int64_t effort() const noexcept { return finder_.effort(); }

  /// Called before each solve. Unless all agents will have a cap, only conflicts among those that
  /// have matter: the theory decides for them and ends the solve when they do not collide.
  void on_solve(bool all_present) { is_part_ = !all_present; }

  void on_assign(std::span<const sat::Lit> newly_true) override;
  void on_retract(std::size_t kept) override;
  void check(sat::Effort effort, sat::TheoryContext& context) override;
  [[nodiscard]] sat::Lit decide(sat::TheoryContext& context) override;
  sat::Lemma explain(sat::Lit implied, std::vector<sat::Lit>& clause) override;

 private:
  struct Agent {
    std::vector<ObstacleId> active;
    Timestep cap = kForever;
    bool is_violated = false;  // the path may be hit or dearer than the cap: in violated_
  };
  /// What a literal on the stack brought about.
  struct Change {
    enum class Kind : std::uint8_t { activation, cap, path };
    Kind kind;
    AgentId agent;
    ObstacleId obstacle;  // activation
    Timestep cap = 0;     // cap: the one before
  };
  class ContextWriter;

  [[nodiscard]] bool is_present(AgentId i) const { return agents_[i].cap != kForever; }
  [[nodiscard]] sat::Truth value(sat::Lit lit) const;
  void notice_new_obstacles();
  void activate(ObstacleId id);
  void lower_cap(AgentId i, Timestep cap);
  void undo(const Change& change);
  /// True if the path does what an active obstacle of the agent forbids.
  [[nodiscard]] bool is_hit(AgentId i, const Path& path) const;

  void mark_violated(AgentId i);
  /// Replaces violated paths of present agents. False if a lemma says that one has none, or if a
  /// limit was met.
  bool replan_all(ContextWriter& writer);
  bool replan(AgentId i, FormulaWriter& writer);
  /// The remembered path with the fewest collisions that a search could have found as well: within
  /// the cap, around the active obstacles, and so cheap that it leaves no bound to refute. Null if
  /// there is none.
  [[nodiscard]] const Path* find_remembered(AgentId i) const;
  /// Adds "i costs more than `cost`, or one of these usages is allowed". The searches' state is
  /// that of the last find_cheapest for i.
  void explain_bound(AgentId i, Timestep cost, FormulaWriter& writer);
  void set_path(AgentId i, const Path& path);
  void check_paths(ContextWriter& writer);
  /// Replaces paths by others within the caps that have fewer collisions; false if none was found.
  /// What recent path lemmas mention is active, as in VSIDS.
  void bump(std::span<const sat::Lit> clause);
  [[nodiscard]] double activity(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    return index < activity_.size() ? activity_[index] : 0;
  }
  bool bypass();
  bool bypass(AgentId i);
  void list_present_collisions();
  void accept();

  LazyModel& model_;
  LimitMonitor& limits_;
  PathIndex paths_;
  EncounterClauses clauses_;
  ObstacleMap obstacle_map_;
  PathFinder finder_;
  Explainer explainer_;
  ExplicitPaths explicit_paths_;
  PathCache cache_;

  IdVector<AgentId, Agent> agents_;
  std::vector<AgentId> violated_;
  std::vector<sat::Lit> stack_;
  std::vector<std::size_t> changes_before_;  // by stack place: size of changes_ when it was pushed
  std::vector<Change> changes_;
  std::vector<Path> replaced_paths_;               // of the path changes
  std::vector<sat::Truth> values_;                 // by variable
  std::vector<std::vector<ObstacleId>> watchers_;  // by variable: obstacles that it controls
  bool is_part_ = false;
  std::vector<double> activity_;  // by variable
  double bump_ = 1;
  std::size_t num_noticed_ = 0;  // obstacles that are in watchers_

  std::vector<Encounter> collisions_;  // scratch, as the next two
  std::vector<std::size_t> slots_;
  Path path_;

  std::optional<Plan> accepted_;
  std::int64_t num_checks_ = 0;
};

}  // namespace quadrille::discrete
