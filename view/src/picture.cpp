// SPDX-License-Identifier: MIT
#include "quadrille/view/picture.hpp"

#include <utility>

#include "scene.hpp"
#include "svg.hpp"

namespace quadrille::view {
namespace {

constexpr std::pair<PictureKind, std::string_view> kNames[] = {
    {PictureKind::map, "map"},
    {PictureKind::space_time, "space-time"},
    {PictureKind::waits, "waits"},
};

std::string draw(const Scene& scene, const PictureOptions& options) {
  Chosen chosen;
  for (const AgentId i : options.agents) chosen.push_back(i.index());
  if (chosen.empty())
    for (std::size_t i = 0; i < scene.agents.size(); ++i) chosen.push_back(i);
  switch (options.kind) {
    case PictureKind::map:
      return draw_map(scene, chosen, options.title);
    case PictureKind::space_time:
      return draw_space_time(scene, chosen, options.title);
    case PictureKind::waits:
      return draw_waits(scene, chosen, options.title);
  }
  return "";
}

std::optional<Error> check(const PictureOptions& options, std::size_t num_agents) {
  for (const AgentId i : options.agents)
    if (i.index() >= num_agents)
      return Error{ErrorCode::out_of_range,
                   "agent " + std::to_string(i.index()) + " is to be drawn, but there are " +
                       std::to_string(num_agents) + " agents",
                   {}};
  return std::nullopt;
}

}  // namespace

std::string_view to_string(PictureKind kind) noexcept {
  for (const auto& [value, name] : kNames)
    if (value == kind) return name;
  return "";
}

std::optional<PictureKind> parse_picture_kind(std::string_view text) noexcept {
  for (const auto& [value, name] : kNames)
    if (name == text) return value;
  return std::nullopt;
}

Result<std::string> picture(const discrete::Instance& instance, const discrete::Plan& plan,
                            const PictureOptions& options) {
  if (auto error = check(options, instance.num_agents())) return *error;
  return draw(make_scene(instance, plan), options);
}

Result<std::string> picture(const continuous::Instance& instance, const continuous::Plan& plan,
                            const PictureOptions& options, const continuous::GridRoadmap* grid) {
  if (auto error = check(options, instance.num_agents())) return *error;
  return draw(make_scene(instance, plan, grid), options);
}

Result<std::string> picture(const continuous::Instance& instance, const continuous::Plan& plan,
                            const PictureOptions& options, const continuous::PoseGrid& poses) {
  if (auto error = check(options, instance.num_agents())) return *error;
  Scene scene = make_scene(instance, plan, &poses.cells());
  add_headings(poses, scene);
  return draw(scene, options);
}

}  // namespace quadrille::view
