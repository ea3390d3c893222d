// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "input.hpp"
#include "output.hpp"
#include "quadrille/discrete/feasibility.hpp"
#include "roadmap/roadmap_info.hpp"
#include "subcommands.hpp"

namespace quadrille::cli {
namespace {

using discrete::Graph;
using discrete::Instance;
using discrete::kUnreachable;

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille info --map maze-32-32-4.map --scen maze-32-32-4-random-1.scen --agents 20\n"
    "  quadrille info --roadmap map.xml --task task.xml --agents 20\n"
    "\n";

/// Sizes of the connected components, largest first.
std::vector<std::size_t> component_sizes(const Graph& graph) {
  std::vector<std::size_t> sizes;
  IdVector<VertexId, bool> seen(graph.num_vertices(), false);
  std::vector<VertexId> queue;
  for (const VertexId root : IdRange<VertexId>(graph.num_vertices())) {
    if (seen[root]) continue;
    queue.assign(1, root);
    seen[root] = true;
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (const VertexId next : graph.neighbours(queue[head]))
        if (!seen[next]) {
          seen[next] = true;
          queue.push_back(next);
        }
    sizes.push_back(queue.size());
  }
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

std::string describe_components(const Graph& graph) {
  constexpr std::size_t kShown = 8;
  const std::vector<std::size_t> sizes = component_sizes(graph);
  std::string text = fmt::format("components {}", sizes.size());
  for (std::size_t i = 0; i < std::min(kShown, sizes.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? ", of " : ", ", sizes[i]);
  if (sizes.size() > kShown) text += ", ...";
  return text + (sizes.empty() ? "\n" : " vertices\n");
}

std::string describe_degrees(const Graph& graph) {
  std::map<std::size_t, std::size_t> count;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    ++count[graph.neighbours(v).size()];
  std::string text = "degrees    ";
  const char* separator = "";
  for (const auto& [degree, vertices] : count) {
    text += fmt::format("{}{}: {}", separator, degree, vertices);
    separator = ", ";
  }
  return text + "\n";
}

/// What each agent needs when it is alone.
std::string describe_distances(const Instance& instance) {
  Cost sum = 0, largest = 0;
  std::size_t unreachable = 0;
  for (const discrete::Task& task : instance.tasks()) {
    const Timestep distance = distances_from(instance.graph(), task.goal)[task.start];
    if (distance == kUnreachable) {
      ++unreachable;
      continue;
    }
    sum += distance;
    largest = std::max<Cost>(largest, distance);
  }
  if (unreachable > 0)
    return fmt::format("distances  {} agents cannot reach their goal\n", unreachable);
  return fmt::format("distances  sum {}, largest {} (lower bounds of sum of costs, makespan)\n",
                     sum, largest);
}

ExitCode run(const InputOptions& options) {
  const auto input = load_input(options);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const Instance& instance = input->instance;
  Console console(false, false);
  console.print(describe_input(*input));
  console.print(describe_components(instance.graph()));
  console.print(describe_degrees(instance.graph()));
  if (!input->task_source.empty()) {
    console.print(describe_distances(instance));
    const discrete::Feasibility verdict = check_feasibility(instance);
    console.print(verdict.feasible ? "feasible   yes, some plan exists\n"
                                   : fmt::format("feasible   no: {}\n", verdict.reason));
  }
  if (console.failure() == 0) return ExitCode::success;
  report_write_failure("-", console.failure());
  return ExitCode::output;
}

}  // namespace

Subcommand add_info(CLI::App& program) {
  CLI::App* app = program.add_subcommand("info", "Describe a map or an instance");
  const auto options = std::make_shared<InputOptions>();
  add_input_options(*app, *options);
  const auto roadmap = std::make_shared<RoadmapOptions>();
  add_roadmap_options(*app, *roadmap);
  app->footer(std::string(kFooter) + kExitCodesHelp);
  return {app, [app, options, roadmap] {
            const bool continuous = is_roadmap(*options, *roadmap);
            std::string wrong = continuous ? check_roadmap_options(*roadmap, *options, Need::map)
                                           : why_no_roadmap(*roadmap);
            if (wrong.empty() && !continuous) wrong = check_input_options(*options, Need::map);
            if (!wrong.empty()) return usage_error(*app, wrong);
            return continuous ? print_roadmap_info(*roadmap, *options) : run(*options);
          }};
}

}  // namespace quadrille::cli
