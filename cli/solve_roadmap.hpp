// SPDX-License-Identifier: MIT
#pragma once

#include "exit_codes.hpp"
#include "quadrille/continuous/solver.hpp"
#include "roadmap_input.hpp"

namespace quadrille::cli {

/// `solve --roadmap`.
struct RoadmapSolveRequest {
  RoadmapOptions input;
  std::optional<std::int64_t> agents;
  continuous::SolveOptions options;
  std::string plan, json;  ///< Output files; empty without, "-" for standard output.
  bool quiet = false;
};

/// Reads, solves, checks and writes.
[[nodiscard]] ExitCode solve_roadmap(RoadmapSolveRequest request);

}  // namespace quadrille::cli
