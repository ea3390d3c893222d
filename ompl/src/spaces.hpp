// SPDX-License-Identifier: MIT
#pragma once

#include <ompl/base/StateSpace.h>

#include <optional>

#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

namespace quadrille::ompl_bridge {

/// Why the states of a space are no places in the plane or in space that straight lanes join;
/// nullopt if they are.
[[nodiscard]] std::optional<Error> refuse(const ::ompl::base::StateSpace& space);

/// Why a place is none of a space that is not refused: it has a height, and the space is flat.
[[nodiscard]] std::optional<Error> refuse(const ::ompl::base::StateSpace& space,
                                          const fleet::Point& place);

/// Both require a space, and a place, that is not refused.
[[nodiscard]] fleet::Point place_of(const ::ompl::base::StateSpace& space,
                                    const ::ompl::base::State& state);
void set_state(const ::ompl::base::StateSpace& space, ::ompl::base::State& state,
               const fleet::Point& place, double yaw);

}  // namespace quadrille::ompl_bridge
