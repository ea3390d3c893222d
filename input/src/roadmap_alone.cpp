// SPDX-License-Identifier: MIT
#include "quadrille/input/roadmap_alone.hpp"

#include <utility>
#include <vector>

#include "quadrille/continuous/quantise.hpp"
#include "quadrille/input/grid.hpp"
#include "roadmap_numbers.hpp"

namespace quadrille::input {

bool is_roadmap_alone(const RoadmapOptions& options, const InputOptions& input) {
  if (options.headings) return is_map_alone(input);
  return !options.roadmap.empty() && options.task.empty();
}

Result<RoadmapInput> with_agents_of(RoadmapInput input, const continuous::Plan& plan,
                                    const RoadmapOptions& options, const std::string& file) {
  continuous::Agent like{{}, {}, continuous::Disc{continuous::PoseGrid::kRadius}};
  if (options.headings) {
    like.speed = continuous::quantise_speed(1, continuous::PoseGrid::kResolution).value();
  } else {
    const auto numbers = quantise(options);
    if (!numbers) return numbers.error();
    like.body = continuous::Disc{numbers->radius};
    like.speed = numbers->speed;
  }
  std::vector<continuous::Agent> agents;
  for (const continuous::Path& path : plan.paths) {
    like.start = path.front().vertex;
    like.goals = path.back().vertex;
    agents.push_back(like);
  }
  const auto now =
      plan.paths.empty() ? continuous::Ticks(0) : plan.paths[AgentId(0)].front().arrive;
  auto instance = continuous::Instance::make(input.instance.shared_roadmap(), std::move(agents),
                                             input.instance.resolution(), {}, {}, now);
  if (!instance) return Error{ErrorCode::invalid_plan, instance.error().message, {file, 0}};
  input.instance = instance->with_whole_moves(input.instance.has_whole_moves());
  input.task_source = file;
  input.rows = input.instance.num_agents();
  return input;
}

}  // namespace quadrille::input
