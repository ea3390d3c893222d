// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// The same instance with all times counted from its `now`, which is 0 there: what searches see.
/// Obstacles that have gone are left out, and of the others what they did before; one that is in
/// the middle of a move is at its beginning before tick 0, as nothing else ever is.
[[nodiscard]] Instance since_now(const Instance& instance);

/// Plans of the one as plans of the other: all times are later by so much. Nothing overflows as
/// long as the result is no later than kMaxTick.
void shift(Plan& plan, Ticks by);

}  // namespace quadrille::continuous
