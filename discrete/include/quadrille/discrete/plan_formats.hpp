// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/core/stated_outcome.hpp"
#include "quadrille/discrete/graph.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The formats of plan files; docs/formats.md and docs/formats-of-others.md show an example of
/// each.
enum class PlanFormat {
  json,        ///< This project's JSON: a plan, or the result of a solve.
  cbsh2,       ///< `Agent 0: (row,column)->(row,column)->`; grids only.
  lns2,        ///< The same as MAPF-LNS2 writes it, without the blank; either is read as the other.
  visualizer,  ///< `0:(x,y),(x,y),`, one line per timestep; grids only. Also read behind the header
               ///< of a result of lacam.
  lacam,       ///< A result of lacam: that, behind the header.
  yaml,        ///< libMultiRobotPlanning's `schedule`.
};
inline constexpr std::array kPlanFormats{PlanFormat::json,  PlanFormat::cbsh2,
                                         PlanFormat::lns2,  PlanFormat::visualizer,
                                         PlanFormat::lacam, PlanFormat::yaml};
[[nodiscard]] std::string_view to_string(PlanFormat format) noexcept;  ///< "json" | "cbsh2" | ...
[[nodiscard]] std::optional<PlanFormat> parse_plan_format(std::string_view text) noexcept;
/// Guesses from the first characters that are not white space: `{` is json, a digit visualizer,
/// `Agent ` cbsh2, the header of a result of lacam lacam, anything else yaml.
[[nodiscard]] PlanFormat detect_plan_format(std::string_view text);
/// .json, .yaml and .yml; other extensions mean nothing.
[[nodiscard]] std::optional<PlanFormat> plan_format_of(const std::filesystem::path& path);

/// A plan as a file states it. Nothing is claimed about its validity: see verify.
struct PlanFile {
  Plan plan;  ///< Paths are as long as in the file; never empty. Vertices belong to the graph.
  StatedOutcome stated;
};

/// Reads a plan on `graph`; without `format` the content decides. Then outputs of the League of
/// Robot Runners without turns are read, too, and, for the agents of an instance, the CSV of the
/// MAPF tracker, whose paths begin at their starts. Errors, with file and line: io, syntax,
/// out_of_range (file above kMaxFileBytes), invalid_plan (a place that is no vertex of the graph; a
/// result without a plan; a header that contradicts the plan; a format that needs a grid, or an
/// instance).
[[nodiscard]] Result<PlanFile> read_plan(std::istream& in, const std::string& file,
                                         const Graph& graph,
                                         std::optional<PlanFormat> format = std::nullopt);
[[nodiscard]] Result<PlanFile> read_plan(const std::filesystem::path& path, const Graph& graph,
                                         std::optional<PlanFormat> format = std::nullopt);

[[nodiscard]] Result<PlanFile> read_plan(std::istream& in, const std::string& file,
                                         const Instance& instance,
                                         std::optional<PlanFormat> format = std::nullopt);
[[nodiscard]] Result<PlanFile> read_plan(const std::filesystem::path& path,
                                         const Instance& instance,
                                         std::optional<PlanFormat> format = std::nullopt);

/// Writes a plan, with its costs where the format has a place for them. Reading it back gives an
/// equal plan, but visualizer and lacam extend all paths to the longest one. Errors: io;
/// invalid_plan if a path is empty, a vertex does not belong to the graph, the format needs a grid,
/// or the plan begins later than at 0, which json alone can say, or not at 0 .. kMaxNow.
[[nodiscard]] std::optional<Error> write_plan(std::ostream& out, const std::string& file,
                                              const Graph& graph, const Plan& plan,
                                              PlanFormat format);

/// The value of the key `plan` in this project's JSON, on one line: per agent a list of `[x, y]`
/// (vertex numbers on graphs that are no grids), one per timestep from Plan::now on, which a key of
/// its own, `now`, says unless it is 0. Requires vertices of the graph.
[[nodiscard]] std::string plan_to_json(const Graph& graph, const Plan& plan);

}  // namespace quadrille::discrete

QUADRILLE_API_END
