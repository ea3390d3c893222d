// SPDX-License-Identifier: MIT
#include "grid/execution_grid.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "asked/execution_page.hpp"
#include "grid/grid_text.hpp"
#include "quadrille/execution/clearance.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {
namespace {

/// Keeps the plan that it looks at.
class GridWatch : public ContactWatch {
 public:
  GridWatch(std::shared_ptr<const discrete::Plan> plan, IdVector<AgentId, bool> leaves)
      : plan_(std::move(plan)), watch_(*plan_, std::move(leaves)) {}
  void add(std::span<const Ticks> before, std::span<const Ticks> after) override {
    watch_.add(before, after);
  }
  [[nodiscard]] std::size_t contacts() const override { return watch_.contacts().size(); }
  [[nodiscard]] std::optional<double> clearance() const override { return std::nullopt; }

 private:
  std::shared_ptr<const discrete::Plan> plan_;
  execution::ConflictWatch watch_;
};

/// Its cells, a timestep for each move.
void add_page_of(input::RoadmapInput page, const input::GridInput& grid, ExecutionCase& made) {
  const continuous::Resolution sizes = page.instance.resolution();
  add_page(std::make_shared<const input::RoadmapInput>(std::move(page)),
           static_cast<std::int64_t>(std::llround(1 / sizes.time)), made);
  made.starts.clear();
  for (const discrete::Agent& agent : grid.instance.agents()) made.starts.push_back(agent.start);
  made.position = [graph = grid.instance.shared_graph(),
                   pitch = 1 / sizes.length](VertexId v) -> TrackRecorder::Place {
    const discrete::Cell cell = graph->layout()->cell_of(v);
    return {pitch * cell.x, pitch * cell.y, 0};
  };
}

}  // namespace

std::string check_execution_grid(const ExecutionArguments& arguments) {
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_discrete("--plan-format");
  return wrong;
}

Result<ExecutionCase> load_execution_grid(const ExecutionArguments& arguments) {
  const auto input = load_grid_input(arguments.input);
  if (!input) return input.error();
  auto file = discrete::read_plan(std::filesystem::path(arguments.plan), input->instance,
                                  arguments.format.discrete);
  if (!file) return file.error();
  auto order = execution::precedences(input->instance, file->plan);
  if (!order) return order.error();
  const auto plan = std::make_shared<const discrete::Plan>(std::move(file->plan));
  IdVector<AgentId, bool> leaves;
  for (const discrete::Agent& agent : input->instance.agents()) leaves.push_back(agent.leaves);
  ExecutionCase made{describe_input(*input),
                     std::move(order).value(),
                     1,
                     true,
                     [graph = input->instance.shared_graph()](VertexId vertex) {
                       return discrete::vertex_name(*graph, vertex);
                     },
                     [plan, leaves] { return std::make_unique<GridWatch>(plan, leaves); }};
  if (auto page = input::as_roadmap(*input)) add_page_of(std::move(page).value(), *input, made);
  return made;
}

}  // namespace quadrille::cli
