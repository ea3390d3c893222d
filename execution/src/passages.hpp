// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/core/result.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::execution {

/// Why some agents would never begin a passage (TimedMove::goes_on), whatever happens: each waits
/// before one for others that wait before theirs. nullopt: all arrive under Executor::couple, if
/// every delay ends (docs/execution.md). Time: a step of the executor per passage at worst.
[[nodiscard]] std::optional<Error> why_passages_block(const Precedences& order);

}  // namespace quadrille::execution
