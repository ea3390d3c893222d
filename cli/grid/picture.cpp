// SPDX-License-Identifier: MIT
#include "grid/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace quadrille::cli {
namespace {

using discrete::arrival;
using discrete::Cell;
using discrete::Graph;
using discrete::GridLayout;
using discrete::Instance;
using discrete::Path;
using discrete::Plan;
using discrete::position;
using discrete::vertex_name;

constexpr std::size_t kLineWidth = 80;
// Beyond these a plan is not readable any more, and belongs into a file.
constexpr std::size_t kMaxAgents = 62;
constexpr std::int32_t kMaxWidth = 40;
constexpr Cost kMaxMakespan = 60;
// Frames: few enough for one look.
constexpr std::size_t kMaxFrameAgents = 26;
constexpr std::size_t kMaxFrameLines = 40;

/// The grid at one timestep, row by row: # blocked, . free, agent i the i-th letter, a capital at
/// one of its goals.
std::vector<std::string> frame(const Instance& instance, const GridLayout& layout, const Plan& plan,
                               Timestep t) {
  const auto columns = static_cast<std::size_t>(layout.width());
  std::vector<std::string> rows(static_cast<std::size_t>(layout.height()),
                                std::string(columns, '#'));
  const auto at = [&](VertexId v) -> char& {
    const Cell cell = layout.cell_of(v);
    return rows[static_cast<std::size_t>(cell.y)][static_cast<std::size_t>(cell.x)];
  };
  for (const VertexId v : IdRange<VertexId>(layout.num_vertices())) at(v) = '.';
  for (const AgentId i : instance.agent_ids()) {
    const VertexId v = position(plan.paths[i], t);
    const char first = instance.agents()[i].goals.contains(v) ? 'A' : 'a';
    at(v) = static_cast<char>(first + static_cast<char>(i.index()));
  }
  return rows;
}

/// All frames, as many beside each other as a line takes; empty if that needs too many lines.
std::string draw_frames(const Instance& instance, const GridLayout& layout, const Plan& plan,
                        Cost makespan) {
  const auto frames = static_cast<std::size_t>(makespan) + 1;
  const std::size_t width = std::max<std::size_t>(static_cast<std::size_t>(layout.width()), 4) + 2;
  const auto height = static_cast<std::size_t>(layout.height());
  const std::size_t per_line = std::max<std::size_t>(1, kLineWidth / width);
  const std::size_t bands = (frames + per_line - 1) / per_line;
  if (bands * (height + 2) > kMaxFrameLines) return "";
  std::string text;
  for (std::size_t first = 0; first < frames; first += per_line) {
    std::vector<std::string> lines(height + 1);
    for (std::size_t t = first; t < std::min(frames, first + per_line); ++t) {
      const auto rows = frame(instance, layout, plan, static_cast<Timestep>(t));
      for (std::size_t line = 0; line <= height; ++line) {
        lines[line].resize((t - first) * width, ' ');
        lines[line] += line == 0 ? fmt::format("t={}", t) : rows[line - 1];
      }
    }
    for (const std::string& line : lines) text += line + "\n";
    text += "\n";
  }
  return text;
}

/// On grids one letter per timestep: U up, D down, L left, R right, . wait; else vertex numbers.
std::string moves(const Graph& graph, const Path& path) {
  std::string text;
  const auto last = static_cast<std::size_t>(arrival(path));
  if (!graph.layout()) {
    for (std::size_t t = 0; t <= last; ++t) text += fmt::format("{} ", path[t].value());
    text.pop_back();
    return text;
  }
  for (std::size_t t = 0; t < last; ++t) {
    const Cell from = graph.layout()->cell_of(path[t]), to = graph.layout()->cell_of(path[t + 1]);
    text += to.x > from.x   ? 'R'
            : to.x < from.x ? 'L'
            : to.y > from.y ? 'D'
            : to.y < from.y ? 'U'
                            : '.';
  }
  return text;
}

}  // namespace

std::string draw_plan(const Instance& instance, const Plan& plan) {
  const Graph& graph = instance.graph();
  const Cost makespan = plan.cost(Objective::makespan);
  if (plan.paths.empty()) return "";
  if (plan.paths.size() > kMaxAgents || makespan > kMaxMakespan ||
      (graph.layout() && graph.layout()->width() > kMaxWidth))
    return "plan       too large to show here; --plan FILE writes it\n";

  std::string text = "\n";
  const bool letters = graph.layout() && plan.paths.size() <= kMaxFrameAgents;
  const std::string frames = letters ? draw_frames(instance, *graph.layout(), plan, makespan) : "";
  text += frames;
  text += fmt::format("{:>5}  {:<10}{:<10}{:>4}  {}\n", "agent", "start", "goal", "cost",
                      graph.layout() ? "moves" : "vertices");
  for (const AgentId i : instance.agent_ids()) {
    const discrete::Agent& task = instance.agents()[i];
    const std::string name =
        frames.empty() ? std::to_string(i.value())
                       : fmt::format("{} {}", static_cast<char>('a' + static_cast<char>(i.index())),
                                     i.value());
    text += fmt::format("{:>5}  {:<10}{:<10}{:>4}  {}\n", name, vertex_name(graph, task.start),
                        vertex_name(graph, plan.paths[i].back()), arrival(plan.paths[i]),
                        moves(graph, plan.paths[i]));
  }
  if (graph.layout()) text += "(U up, D down, L left, R right, . wait)\n";
  return text;
}

}  // namespace quadrille::cli
