// SPDX-License-Identifier: MIT
#pragma once

#include "roadmap/roadmap_report.hpp"

namespace quadrille::cli {

/// Reads, solves, checks and writes.
[[nodiscard]] ExitCode solve_roadmap(RoadmapSolveRequest request);

}  // namespace quadrille::cli
