// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cover/core_table.hpp"
#include "paths/bans.hpp"

namespace quadrille::continuous {

/// Lemmas that say who they are about instead of naming literals, so that they outlive the model
/// of the search that found them.
struct LemmaStock {
  /// Something that one agent may be kept from.
  struct Obstacle {
    /// Of another agent, from `from` on, once that one stays there.
    struct Goal {
      AgentId resident;
      VertexId vertex;
      Ticks from = 0;
    };
    AgentId agent;
    std::vector<Ban> bans;          ///< The first one is the cause. None of a goal.
    std::vector<AgentId> partners;  ///< Of a goal, nobody.
    std::optional<Goal> goal = {};
  };
  enum class Kind : std::uint8_t {
    collision,  ///< Somebody breaks no ban of one of its two obstacles.
    path,       ///< One agent costs its level, if there is one, or breaks a ban of some obstacle.
    pair,       ///< One of two agents costs its level, or breaks a ban of some obstacle.
  };
  struct Lemma {
    Kind kind = Kind::collision;
    std::vector<Level> levels;
    std::vector<std::uint32_t> obstacles;  ///< By index.
    /// Of a path lemma: the level may be too high by now, so that the path has to be looked for.
    bool is_doubtful = false;
  };

  std::vector<Obstacle> obstacles;
  std::vector<Lemma> lemmas;  ///< In the order in which they were found.
};

}  // namespace quadrille::continuous
