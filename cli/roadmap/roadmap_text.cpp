// SPDX-License-Identifier: MIT
#include "roadmap/roadmap_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "frame/output.hpp"
#include "quadrille/continuous/duration_error.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::cli {
namespace {

using continuous::Instance;

std::string range(double least, double most) {
  return least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
}

/// There are agents.
std::string describe_bodies(const Instance& instance) {
  continuous::Length small = geometry::kMaxLength, large = 0;
  std::size_t polygons = 0;
  for (const continuous::Agent& agent : instance.agents()) {
    const continuous::Length reach = geometry::enclosing_radius(agent.body);
    small = std::min(small, reach);
    large = std::max(large, reach);
    if (std::holds_alternative<continuous::ConvexPolygon>(agent.body)) ++polygons;
  }
  const std::string radii = range(continuous::in_input_units(small, instance.resolution()),
                                  continuous::in_input_units(large, instance.resolution()));
  if (polygons == 0) return fmt::format("radius {}", radii);
  return fmt::format("{} polygon{}, all in discs of radius {}", polygons, polygons == 1 ? "" : "s",
                     radii);
}

/// A line about agents with rules of their own; empty if there are none.
std::string describe_rules(const Instance& instance) {
  std::string text;
  const auto add = [&](const char* what, bool (*has)(const continuous::Agent&)) {
    const auto count = std::count_if(instance.agents().begin(), instance.agents().end(), has);
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add("released later", [](const continuous::Agent& a) { return a.release > 0; });
  add("with a deadline", [](const continuous::Agent& a) { return a.deadline.has_value(); });
  add("under way at the beginning", [](const continuous::Agent& a) { return a.under_way; });
  add("that leave at their goal", [](const continuous::Agent& a) { return a.leaves; });
  if (!text.empty()) text = "           " + text + "\n";
  if (!instance.obstacles().empty())
    text += fmt::format("obstacles  {} on paths of their own\n", instance.obstacles().size());
  return text;
}

}  // namespace

void warn_of_durations(const input::RoadmapInput& input) {
  const Instance& instance = input.instance;
  const auto worst = continuous::largest_duration_error(instance);
  if (!worst || worst->relative < continuous::kNotableDurationError) return;
  const continuous::Edge& edge = instance.roadmap().edge(worst->edge);
  report_warning(
      {ErrorCode::out_of_range,
       fmt::format("durations are rounded by up to {:.3g} %: from {} to {}, agent {} is planned to "
                   "take {} instead of {:.4g}; a smaller resolution of time mends that",
                   100 * worst->relative, edge.from.value(), edge.to.value(), worst->agent.value(),
                   continuous::in_input_units(worst->planned, instance.resolution()),
                   worst->exact * instance.resolution().time),
       {input.source, 0}});
}

std::string describe_input(const input::RoadmapInput& input) {
  const Instance& instance = input.instance;
  const continuous::Resolution& resolution = instance.resolution();
  std::string text =
      fmt::format("roadmap    {}: {}{} vertices, {} edges\n", input.source, input.kind,
                  instance.roadmap().num_vertices(), instance.roadmap().num_edges());
  if (input.num_zero_length_edges > 0)
    text += fmt::format("           {} edges of length zero, which take one tick\n",
                        input.num_zero_length_edges);
  for (const std::string& note : input.notes) text += "note       " + note + "\n";
  if (const auto closed = std::count_if(
          instance.roadmap().edges().begin(), instance.roadmap().edges().end(),
          [](const continuous::Edge& e) { return !(e.open_to == continuous::Groups::all()); });
      closed > 0)
    text += fmt::format("           {} of the edges open to some groups of agents only\n", closed);
  if (!input.task_source.empty()) {
    text += fmt::format("agents     {} from {}", instance.num_agents(), input.task_source);
    if (input.rows != instance.num_agents()) text += fmt::format(" (of {})", input.rows);
    if (instance.num_agents() > 0) {
      const auto [slow, fast] =
          std::minmax_element(instance.agents().begin(), instance.agents().end(),
                              [](const auto& a, const auto& b) { return a.speed < b.speed; });
      text += fmt::format(", {}, speed {}", describe_bodies(instance),
                          range(continuous::speed_in_input_units(slow->speed, resolution),
                                continuous::speed_in_input_units(fast->speed, resolution)));
    }
    text += "\n" + describe_rules(instance);
  }
  if (!resolution.is_uniform())
    return text + fmt::format("units      one tick is {}, one length unit is {}\n", resolution.time,
                              resolution.length);
  return text + fmt::format("units      one tick, and one length unit, is {}\n", resolution.time);
}

}  // namespace quadrille::cli
