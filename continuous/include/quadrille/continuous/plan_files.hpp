// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

// Plan files; docs/formats.md has examples. Nothing is repaired, nothing is printed.

namespace quadrille::continuous {

/// The value of `version` in plan files.
inline constexpr int kPlanJsonVersion = 1;

/// Reads a plan in this project's JSON: `version`, `resolution` and `paths`, one list of
/// {vertex, arrive, depart} per agent, in ticks; the last stop has no `depart`. Errors: io; syntax,
/// with the JSON path of the value; invalid_plan for a resolution that is not `resolution`.
[[nodiscard]] Result<Plan> read_plan_json(std::istream& in, const std::string& file,
                                          double resolution);
[[nodiscard]] Result<Plan> read_plan_json(const std::filesystem::path& path, double resolution);
/// Errors: io when the stream fails.
[[nodiscard]] std::optional<Error> write_plan_json(std::ostream& out, const std::string& file,
                                                   const Plan& plan, double resolution);

/// Writes the log of the published continuous-time CBS: one <section> per move or wait, with its
/// duration in the input's unit of time. On grids sections name cells, elsewhere vertex numbers.
[[nodiscard]] std::optional<Error> write_ccbs_log(std::ostream& out, const std::string& file,
                                                  const Instance& instance, const Plan& plan,
                                                  const GridRoadmap* grid, double seconds);

}  // namespace quadrille::continuous
