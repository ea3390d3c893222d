// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "theory/model.hpp"
#include "traffic/steps.hpp"

namespace quadrille::continuous {

/// Turns collisions into clauses that exclude them and much of what is like them. The proofs stand
/// at the functions, and in docs/soundness/continuous.md.
class EncounterClauses {
 public:
  EncounterClauses(Model& model, PathFinder& finder, BanTable& bans)
      : model_(model), finder_(finder), bans_(bans) {}

  /// Adds a clause that the encounter breaks, and returns the obstacles that the two break.
  /// `stay_i`: from when on the first agent's stay at its goal counts as final, at least its
  /// arrival; `stay_j` likewise.
  std::vector<ObstacleId> exclude(const Encounter& encounter, Ticks stay_i, Ticks stay_j,
                                  FormulaWriter& writer);
  /// Where an agent ends: its path does, and it stays there for good.
  struct End {
    AgentId agent;
    VertexId goal;
  };
  /// The same for two agents who are in each other's way where they end: they do not both end
  /// there. Requires that the bodies overlap.
  std::vector<ObstacleId> exclude_ends(const End& i, const End& j, FormulaWriter& writer);

 private:
  struct Party {
    AgentId agent;
    ClassId c;
  };
  std::vector<ObstacleId> exclude_moves(Party i, const Step& a, Party j, const Step& b,
                                        FormulaWriter& writer);
  std::vector<ObstacleId> exclude_stay(Party mover, const Step& move, Party stander,
                                       const Step& stay, Ticks final_from, FormulaWriter& writer);
  /// Adds what b can do along edges that collides with all of `bans_of_a` (starts).
  void lift(Party a, std::span<const Ban> bans_of_a, Party b, Ticks min_length,
            std::vector<Ban>& bans_of_b);
  /// Adds moves of a that collide with any stay of b that `stay` bans.
  void lift_over_stay(Party a, Party b, const Ban& stay, Ticks min_length,
                      std::vector<Ban>& bans_of_a);
  std::vector<ObstacleId> add_pair(AgentId i, std::vector<Ban> bans_i, AgentId j,
                                   std::vector<Ban> bans_j, const sat::Why& why,
                                   FormulaWriter& writer);
  /// Adds what the obstacle alone costs its agent.
  void add_price(ObstacleId id, FormulaWriter& writer);

  Model& model_;
  PathFinder& finder_;
  BanTable& bans_;
};

}  // namespace quadrille::continuous
