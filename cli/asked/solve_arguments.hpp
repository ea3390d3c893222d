// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frame/arguments.hpp"
#include "frame/input_options.hpp"
#include "frame/picture_arguments.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// What `solve` was asked on the command line, for either domain.
struct SolveArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  /// Roadmaps take the objective, the limits, the gap, `explain` and `debug.audit` of these.
  discrete::SolveOptions options;
  std::optional<discrete::System> system;
  std::optional<discrete::CheckSchedule> check;
  std::optional<std::int64_t> seed, threads, memory_mib;
  std::string initial_plan, known_plan;  ///< File names; empty without one.
  std::string plan, json, view, proof;   ///< Output files; empty without, "-" for standard output.
  PictureArguments picture;
  PlanFormats plan_format;
  std::optional<double> known_bound;  ///< In the units of the input.
  std::optional<double> plan_every;   ///< Seconds.
  std::optional<SecondVerifier> check_with;
  bool history = false;
  bool quiet = false;
  /// Instead of the plan, show why none is cheaper, by as few agents as are found (`explain`).
  bool finds_reasons = false;
};

/// What is wrong with the options about outputs, in either domain; empty if nothing is.
[[nodiscard]] std::string check_solve_outputs(const SolveArguments& arguments);

}  // namespace quadrille::cli
