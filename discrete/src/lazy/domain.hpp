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
#include "lazy/path_search.hpp"
#include "lazy/separation.hpp"
#include "paths/path_index.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/lazy/theory.hpp"

namespace quadrille::discrete {

/// Paths on a graph in discrete time, for lazy::PathTheory, which says what the functions are for.
class DiscreteDomain {
 public:
  using Paths = TrailedPaths;
  using Plan = discrete::Plan;
  using Conflict = Encounter;
  using Cheapest = PathSearch::Cheapest;

  static constexpr bool kAbsentWithoutCap = true;
  static constexpr bool kSearchesToCap = true;

  /// Both outlive the domain. Plans free paths that avoid each other where that is easy.
  DiscreteDomain(LazyModel& model, LimitMonitor& limits, ExplicitPaths::Price price);

  [[nodiscard]] std::size_t num_agents() const { return model_.instance().num_agents(); }
  [[nodiscard]] LazyModel& vocabulary() noexcept { return model_; }
  [[nodiscard]] const LazyModel& vocabulary() const noexcept { return model_; }
  [[nodiscard]] const ObstacleTable& obstacles() const { return model_.obstacles(); }

  [[nodiscard]] Paths& paths() noexcept { return trailed_paths_; }
  [[nodiscard]] const Paths& paths() const noexcept { return trailed_paths_; }
  [[nodiscard]] Cost cost(const Path& path) const { return trailed_paths_.cost(path); }
  [[nodiscard]] static bool is_same(const Path& known, const Path& found) { return known == found; }
  [[nodiscard]] static const Path& make_path(AgentId, const Path& found) { return found; }
  static std::optional<ObstacleId>* hint(const Path&) { return nullptr; }
  [[nodiscard]] Plan plan() const;

  [[nodiscard]] Cheapest find_cheapest(AgentId i, const std::vector<ObstacleId>& obstacles,
                                       Cost cap) {
    return search_.find_cheapest(i, obstacles, static_cast<Timestep>(cap));
  }
  [[nodiscard]] static std::vector<ObstacleId> blame(const Cheapest& found, Cost bound) {
    return found.blame(static_cast<Timestep>(bound - 1));
  }
  void on_explained(const lazy::Explanation& lemma, const LazyTrail& trail, FormulaWriter& writer);
  void on_obstacles(FormulaWriter& writer) { explicit_paths_.link_new_obstacles(writer); }

  /// Tries other paths within the caps with fewer collisions.
  void before_conflicts(LazyTrail& trail);
  /// In the order of time.
  [[nodiscard]] std::vector<Encounter> conflicts(LazyTrail& trail);
  std::vector<ObstacleId> exclude(const Encounter& encounter, const LazyTrail& trail,
                                  FormulaWriter& writer) {
    return clauses_.exclude(encounter, cap_of(trail, encounter.first), writer);
  }

  [[nodiscard]] Separation separation(LazyTrail& trail) {
    return {paths_, trail, search_, limits_};
  }
  [[nodiscard]] const PartDecisions& decisions() const noexcept { return decisions_; }
  [[nodiscard]] Effort effort(std::int64_t /*num_assigned*/) const noexcept {
    return search_.effort() * Effort::nanoseconds(1250);
  }

 private:
  void set_free_paths();

  LazyModel& model_;
  LimitMonitor& limits_;
  PathIndex paths_;
  TrailedPaths trailed_paths_;
  PathSearch search_;
  EncounterClauses clauses_;
  ExplicitPaths explicit_paths_;
  PartDecisions decisions_;
};

}  // namespace quadrille::discrete
