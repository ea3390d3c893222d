// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::input {

/// Whether the options name a roadmap, or a map for robots that turn, and no agents. Requires
/// options that name a roadmap.
[[nodiscard]] bool is_roadmap_alone(const RoadmapOptions& options, const InputOptions& input);
/// The roadmap of a plan, with agents of the options' radius and speed that begin and end where its
/// paths do; the instance begins when the first path does. `file`: that of the plan. Errors
/// (invalid_plan): what Instance::make says of such agents, above all two that overlap where they
/// begin or end. Requires a plan whose paths have stops, and what load_roadmap_input made of these
/// options, which name a roadmap alone.
[[nodiscard]] Result<RoadmapInput> with_agents_of(RoadmapInput input, const continuous::Plan& plan,
                                                  const RoadmapOptions& options,
                                                  const std::string& file);

}  // namespace quadrille::input
