// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>

#include "quadrille/continuous/plan_files.hpp"

namespace quadrille::continuous {

[[nodiscard]] Result<PlanFile> read_json_plan(const std::string& text, const std::string& file,
                                              const Instance& instance);
void write_json_plan(std::ostream& out, const Instance& instance, const Plan& plan);

[[nodiscard]] Result<PlanFile> read_ccbs_log(const std::string& text, const std::string& file,
                                             const Instance& instance, const GridRoadmap* grid);
/// Why a log does not say the same as the path, which is not empty; empty if it does. Paths that
/// break no rule can be written.
[[nodiscard]] std::string why_not_in_log(const Instance& instance, AgentId agent, const Path& path);
void write_ccbs_log(std::ostream& out, const Instance& instance, const Plan& plan,
                    const GridRoadmap* grid);

}  // namespace quadrille::continuous
