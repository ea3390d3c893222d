// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "quadrille/core/ids.hpp"

namespace quadrille::discrete {

/// The end of what never ends.
inline constexpr Timestep kForever = INT32_MAX;

}  // namespace quadrille::discrete
