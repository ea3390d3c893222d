// SPDX-License-Identifier: MIT
#include "quadrille/view/page.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include "page_parts.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/core/in_names.hpp"
#include "scene.hpp"
#include "scene_json.hpp"
#include "svg.hpp"

namespace quadrille::view {
namespace {

/// What is said in words calls agents by their names.
void call_by_names(const PageOptions& options, Scene& scene) {
  const auto agent = [&](std::size_t i) -> std::optional<std::string> {
    if (i >= options.agent_names.size() || options.agent_names[i].empty()) return std::nullopt;
    return options.agent_names[i];
  };
  const auto vertex = [](std::size_t) -> std::optional<std::string> { return std::nullopt; };
  for (SceneViolation& violation : scene.violations)
    violation.message = in_names(violation.message, {agent, vertex});
}

/// The document with its marks replaced. What is put in is not looked at again.
std::string fill(Scene scene, PageOptions options) {
  call_by_names(options, scene);
  if (options.title.empty()) {
    const std::size_t count = scene.agents.size();
    options.title = (options.obstruction ? "No plan for " : "Plan of ") + std::to_string(count) +
                    (count == 1 ? " agent" : " agents");
  }
  const PageParts parts = page_parts();
  std::string html;
  std::string_view rest = parts.document;
  while (true) {
    const std::size_t begin = rest.find('@');
    html += rest.substr(0, begin);
    if (begin == std::string_view::npos) return html;
    const std::size_t end = rest.find('@', begin + 1);
    const std::string_view mark = rest.substr(begin + 1, end - begin - 1);
    if (mark == "TITLE") html += escaped(options.title);
    if (mark == "STYLE") html += parts.style;
    if (mark == "DATA") html += scene_json(scene, options);
    if (mark == "SCRIPT")
      for (const std::string_view script : parts.scripts) html += script;
    rest.remove_prefix(end + 1);
  }
}

}  // namespace

std::string page(const discrete::Instance& instance, const discrete::Plan& plan,
                 const PageOptions& options) {
  Scene scene = make_scene(instance, plan);
  if (options.attribution) add_attribution(instance, *options.attribution, scene);
  add_precedences(instance, plan, scene);
  if (options.obstruction) scene.violations.clear();
  return fill(std::move(scene), options);
}

namespace {

std::string page_of(Scene scene, const continuous::Instance& instance, const continuous::Plan& plan,
                    const PageOptions& options) {
  if (options.attribution) add_attribution(*options.attribution, scene);
  add_precedences(instance, plan, scene);
  if (options.obstruction) scene.violations.clear();
  return fill(std::move(scene), options);
}

}  // namespace

std::string page(const continuous::Instance& instance, const continuous::Plan& plan,
                 const PageOptions& options, const continuous::GridRoadmap* grid) {
  return page_of(make_scene(instance, plan, grid), instance, plan, options);
}

std::string page(const continuous::Instance& instance, const continuous::Plan& plan,
                 const PageOptions& options, const continuous::PoseGrid& poses) {
  Scene scene = make_scene(instance, plan, &poses.cells());
  add_headings(poses, scene);
  return page_of(std::move(scene), instance, plan, options);
}

std::string page(const continuous::Instance& instance, const std::vector<Track>& tracks,
                 const PageOptions& options, const continuous::GridRoadmap* grid) {
  QUADRILLE_REQUIRE(tracks.size() == instance.num_agents(), "one track per agent");
  for (const Track& track : tracks) QUADRILLE_REQUIRE(!track.empty(), "at least one sight");
  Scene scene = make_scene(instance, continuous::Plan{}, grid);
  add_tracks(tracks, scene);
  return fill(std::move(scene), options);
}

}  // namespace quadrille::view
