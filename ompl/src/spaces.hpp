// SPDX-License-Identifier: MIT
#pragma once

#include <ompl/base/StateSpace.h>

#include <optional>

#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

namespace quadrille::ompl_bridge {

/// Why the states of a space are no places in the plane that straight lanes join; nullopt if they
/// are.
[[nodiscard]] std::optional<Error> refuse(const ::ompl::base::StateSpace& space);

/// Both require a space that is not refused.
[[nodiscard]] fleet::Point place_of(const ::ompl::base::StateSpace& space,
                                    const ::ompl::base::State& state);
void set_state(const ::ompl::base::StateSpace& space, ::ompl::base::State& state,
               const fleet::Point& place, double yaw);

}  // namespace quadrille::ompl_bridge
