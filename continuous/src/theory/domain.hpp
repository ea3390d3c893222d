// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/lazy/theory.hpp"
#include "theory/current_paths.hpp"
#include "theory/encounters.hpp"
#include "theory/model.hpp"
#include "theory/pair_lemmas.hpp"
#include "theory/path_search.hpp"
#include "traffic/meetings.hpp"

namespace quadrille::continuous {

/// Paths on a roadmap in continuous time, for lazy::PathTheory, which says what the functions are
/// for. A path's cost is its arrival; floors say from which cost on a stay at the goal is final.
class ContinuousDomain {
 public:
  using Paths = CurrentPaths;
  using Plan = continuous::Plan;
  using Conflict = Encounter;
  using Cheapest = PathSearch::Cheapest;

  static constexpr bool kAbsentWithoutCap = false;
  static constexpr bool kSearchesToCap = false;

  /// `model` outlives the domain.
  explicit ContinuousDomain(Model& model);

  [[nodiscard]] std::size_t num_agents() const { return model_.instance().num_agents(); }
  [[nodiscard]] Model& vocabulary() noexcept { return model_; }
  [[nodiscard]] const Model& vocabulary() const noexcept { return model_; }
  [[nodiscard]] const IdVector<ObstacleId, Obstacle>& obstacles() const {
    return model_.obstacles();
  }

  [[nodiscard]] Paths& paths() noexcept { return paths_; }
  [[nodiscard]] const Paths& paths() const noexcept { return paths_; }
  [[nodiscard]] static Cost cost(const TimedPath& path) { return as_cost(path.arrival); }
  [[nodiscard]] static bool is_same(const KnownPathRef& known, const TimedPath& found) {
    return known->path == found;
  }
  [[nodiscard]] static bool is_same(const KnownPathRef& known, const KnownPathRef& other) {
    return known == other;
  }
  [[nodiscard]] KnownPathRef make_path(AgentId i, const TimedPath& found) {
    return known_path(model_.instance(), i, found, ++last_version_);
  }
  [[nodiscard]] static const KnownPathRef& make_path(AgentId, const KnownPathRef& known) {
    return known;
  }
  static std::optional<ObstacleId>* hint(const KnownPathRef& path) { return &path->breaks; }
  [[nodiscard]] Plan plan() const;

  [[nodiscard]] Cheapest find_cheapest(AgentId i, const std::vector<ObstacleId>& obstacles,
                                       Cost cap) {
    return search_.find(i, obstacles, cap < kAnyCost ? cap + 1 : kAnyCost);
  }
  [[nodiscard]] static std::vector<ObstacleId> blame(const Cheapest& found, Cost bound) {
    return found.blame(bound);
  }
  /// Tries to find a stronger lemma of two agents.
  void on_explained(const lazy::Explanation& lemma, const PathTrail& trail, FormulaWriter& writer);
  void on_obstacles(FormulaWriter& /*writer*/) {}

  void before_conflicts(PathTrail& /*trail*/) {}
  /// The first one of each two agents.
  [[nodiscard]] std::vector<Encounter> conflicts(const PathTrail& trail);
  std::vector<ObstacleId> exclude(const Encounter& encounter, const PathTrail& trail,
                                  FormulaWriter& writer);

  [[nodiscard]] PairLemmas& pair_lemmas() noexcept { return pair_lemmas_; }
  /// A least-squares fit to 48 runs on six maps: edges and visits 50 ns, steps of pairs 27 ns,
  /// literals 150 ns.
  [[nodiscard]] Effort effort(std::int64_t num_assigned) const noexcept {
    return search_.effort() + effort_of_paths(finder_.effort()) + pair_lemmas_.effort() +
           num_assigned * Effort::nanoseconds(150) +
           meetings_.num_comparisons() * Effort::microseconds(5);
  }

 private:
  /// What i costs at least: its path does, or literals say so.
  [[nodiscard]] Cost current_cost(AgentId i, const PathTrail& trail) const;
  /// Where an agent with a choice and another one end, if they would be in each other's way there.
  [[nodiscard]] bool do_ends_overlap(AgentId i, AgentId j);
  [[nodiscard]] EncounterClauses::End end_of(AgentId i) const;
  /// True if a lemma of the two agents excludes the encounter.
  bool note_collision(const Encounter& encounter, const PathTrail& trail, FormulaWriter& writer);

  Model& model_;
  CurrentPaths paths_;
  PathSearch search_;
  PathFinder finder_;  // of clauses_, as the next one
  BanTable bans_;
  EncounterClauses clauses_;
  PairLemmas pair_lemmas_;
  std::uint64_t last_version_ = 0;
  Meetings meetings_;
};

}  // namespace quadrille::continuous
