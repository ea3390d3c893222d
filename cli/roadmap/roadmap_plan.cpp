// SPDX-License-Identifier: MIT
#include "roadmap/roadmap_plan.hpp"

#include <sstream>
#include <utility>

#include "quadrille/input/roadmap_alone.hpp"
#include "quadrille/text/sniff.hpp"

namespace quadrille::cli {

Result<input::RoadmapInput> RoadmapPlan::load() {
  auto input = load_roadmap_input(options_, input_);
  if (!input || !is_roadmap_alone(options_, input_)) return input;
  if (text() && text::sniff(*text()) == text::FileKind::ccbs_log) {
    std::istringstream in(*text());
    const auto plan =
        continuous::read_log_alone(in, plan_.file(), input->instance, input->grid_or_null());
    if (!plan) return plan.error();
    return with_agents_of(std::move(input).value(), *plan, options_, plan_.file());
  }
  const auto file = read(*input);
  if (!file) return file.error();
  return with_agents_of(std::move(input).value(), file->plan, options_, plan_.file());
}

Result<continuous::PlanFile> RoadmapPlan::read(const input::RoadmapInput& input) {
  if (!text()) return text().error();
  std::istringstream in(*text());
  return continuous::read_plan(in, plan_.file(), input.instance, input.grid_or_null(), format_);
}

}  // namespace quadrille::cli
