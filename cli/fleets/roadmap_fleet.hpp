// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "fleets/dispatch.hpp"
#include "fleets/dispatch_run.hpp"
#include "fleets/live_fleet.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// Both keep references to the input, and fail as dispatch::Dispatcher::make.
[[nodiscard]] Result<std::unique_ptr<LiveFleet>> serve_on_roadmap(
    const DispatchArguments& arguments, const input::RoadmapInput& input);
[[nodiscard]] std::optional<Error> run_on_roadmap(const DispatchArguments& arguments,
                                                  const input::RoadmapInput& input,
                                                  DispatchRun& run);
/// What there is to do.
[[nodiscard]] DispatchWork work_on_roadmap(const input::RoadmapInput& input);

}  // namespace quadrille::cli
