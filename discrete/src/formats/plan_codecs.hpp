// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan_formats.hpp"

namespace quadrille::discrete {

// One pair of functions per format; see read_plan and write_plan. The text has no NUL byte; the
// plan to write has no empty path and only vertices of the graph. All but json and yaml require
// a grid.
[[nodiscard]] Result<PlanFile> read_json_plan(const std::string& text, const std::string& file,
                                              const Graph& graph);
[[nodiscard]] Result<PlanFile> read_cbsh2_plan(const std::string& text, const std::string& file,
                                               const Graph& graph);
[[nodiscard]] Result<PlanFile> read_visualizer_plan(const std::string& text,
                                                    const std::string& file, const Graph& graph);
/// The header has to be there.
[[nodiscard]] Result<PlanFile> read_lacam_plan(const std::string& text, const std::string& file,
                                               const Graph& graph);
[[nodiscard]] Result<PlanFile> read_yaml_plan(const std::string& text, const std::string& file,
                                              const Graph& graph);

// Read only.
[[nodiscard]] Result<PlanFile> read_planviz_plan(const std::string& text, const std::string& file,
                                                 const Graph& graph);
/// Paths begin at the starts of `agents`.
[[nodiscard]] Result<PlanFile> read_tracker_plan(const std::string& text, const std::string& file,
                                                 const Graph& graph,
                                                 const IdVector<AgentId, Agent>& agents);

void write_json_plan(std::ostream& out, const Graph& graph, const Plan& plan);
/// `colon`: what stands behind the number of an agent.
void write_cbsh2_plan(std::ostream& out, const Graph& graph, const Plan& plan,
                      std::string_view colon);
void write_visualizer_plan(std::ostream& out, const Graph& graph, const Plan& plan);
void write_lacam_plan(std::ostream& out, const Graph& graph, const Plan& plan);
void write_yaml_plan(std::ostream& out, const Graph& graph, const Plan& plan);

/// One path as JSON, such as `[[0, 0], [1, 0]]`.
[[nodiscard]] std::string path_to_json(const Graph& graph, const Path& path);

}  // namespace quadrille::discrete
