// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::execution {

using geometry::Ticks;

/// The offsets of two moves at which they collide lie strictly between these two, which are safe
/// whole ticks, as near as can be. All real offsets at or beyond either are safe as well, because
/// the unsafe ones form one interval.
struct UnsafeWindow {
  Ticks below = 0;
  Ticks above = 0;
};

/// None if no offset is unsafe. A window that contains no whole tick is found as well, because real
/// robots are delayed by fractions of a tick; only one shorter than 2^-20 ticks (longer for moves
/// of more than 2^20 ticks, by as much as those are longer) may be overlooked.
[[nodiscard]] std::optional<UnsafeWindow> unsafe_window(const geometry::BodyPair& bodies,
                                                        const geometry::Motion& a,
                                                        const geometry::Motion& b);

}  // namespace quadrille::execution
