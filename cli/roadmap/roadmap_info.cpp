// SPDX-License-Identifier: MIT
#include "roadmap/roadmap_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "answers/graph_shape.hpp"
#include "frame/output.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

using continuous::EdgeId;
using continuous::in_input_units;
using continuous::Instance;
using continuous::Roadmap;

/// Components are connected by edges of any direction; degrees count the edges that leave.
GraphShape shape_of(const Roadmap& roadmap) {
  GraphShape shape;
  std::vector<bool> seen(roadmap.num_vertices(), false);
  std::vector<VertexId> queue;
  const auto visit = [&](VertexId v) {
    if (seen[v.index()]) return;
    seen[v.index()] = true;
    queue.push_back(v);
  };
  for (const VertexId root : IdRange<VertexId>(roadmap.num_vertices())) {
    ++shape.degrees[roadmap.out_edges(root).size()];
    queue.clear();
    visit(root);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const VertexId v = queue[head];
      for (const EdgeId e : roadmap.out_edges(v)) visit(roadmap.edge(e).to);
      for (const EdgeId e : roadmap.in_edges(v)) visit(roadmap.edge(e).from);
    }
    if (!queue.empty()) shape.components.push_back(queue.size());
  }
  return shape;
}

std::string describe_agents(const Instance& instance) {
  Cost sum = 0, largest = 0;
  for (const AgentId i : instance.agent_ids()) {
    const Cost cost = continuous::as_cost(free_cost(instance, i).value());
    sum += cost;
    largest = std::max(largest, cost);
  }
  const continuous::Resolution& resolution = instance.resolution();
  return fmt::format(
      "classes    {} of agents with equal body, speed and open edges\n"
      "distances  sum {}, largest {} (lower bounds of sum of costs, makespan)\n",
      instance.num_classes(), in_input_units(sum, resolution), in_input_units(largest, resolution));
}

}  // namespace

ExitCode print_roadmap_info(const RoadmapOptions& options, const InputOptions& input_options) {
  const auto input = load_roadmap_input(options, input_options);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  Console console(false, false);
  console.print(describe_input(*input));
  console.print(describe_shape(shape_of(input->instance.roadmap())));
  if (!input->task_source.empty()) console.print(describe_agents(input->instance));
  if (console.failure() == 0) return ExitCode::success;
  report_write_failure("-", console.failure());
  return ExitCode::output;
}

}  // namespace quadrille::cli
