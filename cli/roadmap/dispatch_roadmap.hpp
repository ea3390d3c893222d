// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"

namespace CLI {
class App;
}

namespace quadrille::cli {

/// Calls where no number is given.
inline constexpr std::int64_t kDispatchSteps = 1'000;

/// What `quadrille dispatch` was asked. Times are in the unit of the input.
struct DispatchArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::optional<std::int64_t> steps, seed;
  std::optional<double> step, service, pauses, longest, effort, reach, patience, wall;
  bool has_own_tasks = false, does_not_improve = false, quiet = false, serves = false;
  std::string json, view;
};

/// Lets the robots of a roadmap or a grid work, and reports what came of it; or serves others.
ExitCode dispatch_on_roadmap(const CLI::App& app, DispatchArguments& arguments);

}  // namespace quadrille::cli
