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
  if (text() && text::sniff(*text()) == text::FileKind::ccbs_log)
    return Error{ErrorCode::invalid_plan,
                 "a log of CCBS is read for the agents of a task, which is missing",
                 {plan_.file(), 0}};
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
