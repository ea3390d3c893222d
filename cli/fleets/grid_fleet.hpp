// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "fleets/dispatch.hpp"
#include "fleets/dispatch_run.hpp"
#include "fleets/live_fleet.hpp"
#include "quadrille/input/grid.hpp"

namespace quadrille::cli {

/// Both keep references to the input, and fail as dispatch::GridDispatcher::make, and for instances
/// with rules.
[[nodiscard]] Result<std::unique_ptr<LiveFleet>> serve_on_grid(const DispatchArguments& arguments,
                                                               const input::GridInput& input);
[[nodiscard]] std::optional<Error> run_on_grid(const DispatchArguments& arguments,
                                               const input::GridInput& input, DispatchRun& run);
/// What there is to do.
[[nodiscard]] DispatchWork work_on_grid(const input::GridInput& input);

}  // namespace quadrille::cli
