// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// Says on stderr by how much durations are rounded, if that is notable (docs/cli.md).
void warn_of_durations(const input::RoadmapInput& input);

/// The lines "roadmap", "agents" and "units" of the human output.
[[nodiscard]] std::string describe_input(const input::RoadmapInput& input);

}  // namespace quadrille::cli
