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

/// Who sends the robots about: a window of timesteps that slides along, where they go cell by cell
/// all at the same time; or courses on roadmaps, with clocks of their own.
enum class DispatcherKind { grid, roadmap };

/// What `quadrille dispatch` was asked. Times are in the unit of the input.
struct DispatchArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::optional<DispatcherKind> dispatcher;  ///< By default what the input is.
  std::optional<std::int64_t> steps, seed, window;
  std::optional<double> step, service, pauses, longest, effort, reach, patience, wall;
  bool has_own_tasks = false, does_not_improve = false, quiet = false, serves = false;
  std::string json, view;
};

/// Lets the robots of a roadmap or a grid work, and reports what came of it; or serves others.
ExitCode dispatch_fleet(const CLI::App& app, DispatchArguments& arguments);

}  // namespace quadrille::cli
