// SPDX-License-Identifier: MIT
#pragma once

#include "timed/road.hpp"

namespace quadrille_check {

/// Whether the interiors meet at a moment at which both motions last, ends included. Exact for
/// coordinates, radii and corners up to 2^40 in size, times up to 2^61, moves that last up to 2^40.
[[nodiscard]] bool do_meet(const Motion& a, const Motion& b);

}  // namespace quadrille_check
