// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "quadrille/core/ids.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// Whether an agent has to stay where it is from `t` to t + 1, as told.
using IsHeld = std::function<bool(AgentId agent, VertexId at, Timestep t)>;

/// The same vertices in the same order, each agent as early as the order of the visits to each
/// vertex and those that are held up allow: nobody enters a vertex before the one that was there
/// before it by the paths has left it, or leaves it at the same time. Such paths do not collide,
/// whoever is held up (docs/execution.md), and nobody waits for ever for somebody who is not.
/// Requires paths of one length by agent that do not collide; the result has that length too, so
/// that ends may be cut off. Agents go on after the window as they like. O(size of the
/// paths + vertices).
[[nodiscard]] std::vector<Path> retimed(std::size_t num_vertices, const std::vector<Path>& paths,
                                        const IsHeld& is_held);

}  // namespace quadrille::discrete
