// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/continuous/grid.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/stated_outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// The formats of plan files; docs/formats.md and docs/formats-of-others.md show an example of
/// each.
enum class PlanFormat {
  json,  ///< This project's JSON: a plan, or the result of a solve. Exact.
  ccbs,  ///< The log of the published continuous-time CBS, XML.
};
[[nodiscard]] std::string_view to_string(PlanFormat format) noexcept;  ///< "json" | "ccbs"
[[nodiscard]] std::optional<PlanFormat> parse_plan_format(std::string_view text) noexcept;
/// .json and .xml; other extensions mean nothing.
[[nodiscard]] std::optional<PlanFormat> plan_format_of(const std::filesystem::path& path);

/// A plan as a file states it. Nothing is claimed about its validity: see verify.
struct PlanFile {
  Plan plan;  ///< Vertices belong to the roadmap; no path is empty.
  /// In ticks. A cost that a log states with its own rounding counts as that of the plan.
  StatedOutcome stated;
};

/// Reads a plan for `instance`; without `format` the first character that is no white space
/// decides: `<` is ccbs, anything else json. `grid`: the grid that the roadmap comes from, if any;
/// a log that names cells needs it. In a log, waits are rounded to the nearest tick, and a move
/// that takes as long as its edge, up to two ticks, takes exactly as long. Errors, with file and
/// line: io, syntax, out_of_range, invalid_plan (a vertex that the roadmap does not have, another
/// resolution, no plan, sections that do not fit together).
[[nodiscard]] Result<PlanFile> read_plan(std::istream& in, const std::string& file,
                                         const Instance& instance,
                                         const GridRoadmap* grid = nullptr,
                                         std::optional<PlanFormat> format = std::nullopt);
[[nodiscard]] Result<PlanFile> read_plan(const std::filesystem::path& path,
                                         const Instance& instance,
                                         const GridRoadmap* grid = nullptr,
                                         std::optional<PlanFormat> format = std::nullopt);

/// The paths of a log of CCBS whose agents are not known: where they begin and end is where agents
/// do. A move takes as long as the log says, which is not what its edge takes. `roadmap`: an
/// instance without agents. Errors as those of `read_plan`.
[[nodiscard]] Result<Plan> read_log_alone(std::istream& in, const std::string& file,
                                          const Instance& roadmap,
                                          const GridRoadmap* grid = nullptr);

/// Writes a plan. Reading it back with the same instance and grid gives an equal plan. In ccbs
/// there is one <section> per move or wait, with its duration in the input's unit of time; with a
/// grid, sections name cells, else vertex numbers. Errors: io; invalid_plan if a path is empty or a
/// vertex is none of the roadmap's, and in ccbs for what a log cannot express: paths that begin
/// later than tick 0, that go back in time or move without leaving, moves that are by a tick or two
/// not as long as their edges take, and more paths than agents. Valid plans have nothing of these.
[[nodiscard]] std::optional<Error> write_plan(std::ostream& out, const std::string& file,
                                              const Instance& instance, const Plan& plan,
                                              PlanFormat format, const GridRoadmap* grid = nullptr);

/// The value of the key `plan` in this project's JSON: per agent, on a line of its own, the list of
/// its stops with vertex, place, and times in the input's unit and in ticks. Requires vertices of
/// the roadmap.
[[nodiscard]] std::string plan_to_json(const Instance& instance, const Plan& plan);

}  // namespace quadrille::continuous

QUADRILLE_API_END
