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
void write_ccbs_log(std::ostream& out, const Instance& instance, const Plan& plan,
                    const GridRoadmap* grid);

}  // namespace quadrille::continuous
