// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/obstacles.hpp"
#include "paths/path_index.hpp"
#include "quadrille/sat/lemma.hpp"

namespace quadrille::discrete {

/// A rectangle of cells that two agents cross, one from side to side and one from top to bottom, so
/// fast that each is in a cell at only one time: they collide somewhere (Li et al. 2019, AAAI).
struct Rectangle {
  struct Side {
    AgentId agent;
    /// What its agent can do of entering (leaving) through this side; in the order of time.
    std::vector<Visit> visits;
    /// The agent starts in it: it enters here whatever it does.
    bool inevitable = false;
  };
  std::array<Side, 4> sides;  // entry and exit of one agent, then of the other
  sat::why::Rectangle why;
};

/// The rectangle around a vertex conflict of two paths on a grid; nullopt if they do not cross, or
/// if an agent cannot make any visit of a side. Each path uses both of its sides. No two paths of
/// the agents that use all four sides are free of collisions.
[[nodiscard]] std::optional<Rectangle> find_rectangle(const GridLayout& layout,
                                                      const AgentDistances& first,
                                                      const AgentDistances& second,
                                                      const PathIndex& paths,
                                                      const Encounter& conflict);

}  // namespace quadrille::discrete
