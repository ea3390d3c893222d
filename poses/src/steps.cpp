// SPDX-License-Identifier: MIT
#include "quadrille/poses/steps.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/discrete/solver.hpp"

namespace quadrille::poses {
namespace {

using continuous::Pose;
using continuous::PoseGrid;
using continuous::Ticks;

discrete::Graph cells_of(const PoseGrid& grid) {
  const continuous::GridRoadmap& cells = grid.cells();
  const auto width = static_cast<std::size_t>(cells.width());
  std::vector<bool> passable(width * static_cast<std::size_t>(cells.height()), false);
  for (const VertexId v : IdRange<VertexId>(cells.roadmap()->num_vertices())) {
    const continuous::Cell cell = cells.cell(v);
    passable[static_cast<std::size_t>(cell.y) * width + static_cast<std::size_t>(cell.x)] = true;
  }
  return discrete::Graph::grid(cells.width(), cells.height(), passable);
}

discrete::Cell cell_of(const PoseGrid& grid, VertexId pose) {
  const continuous::Cell cell = grid.pose(pose).cell;
  return {cell.x, cell.y};
}

Pose pose_of(discrete::Cell cell, Heading heading) { return {{cell.x, cell.y}, heading}; }

/// Goals are cells with all their headings, and nothing is said about the agent that a discrete one
/// without rules does not know.
bool is_plain(const PoseGrid& grid, const continuous::Agent& agent) {
  const auto* const disc = std::get_if<geometry::Disc>(&agent.body);
  if (disc == nullptr || disc->radius > PoseGrid::kRadius || !agent.shapes.empty()) return false;
  if (agent.release > 0 || agent.deadline || agent.leaves || agent.under_way ||
      agent.overlaps_at_start)
    return false;
  const auto goals = agent.goals.vertices();
  return std::all_of(goals.begin(), goals.end(), [&](VertexId goal) {
    return std::all_of(kHeadings.begin(), kHeadings.end(), [&](Heading heading) {
      return agent.goals.contains(*grid.vertex({grid.pose(goal).cell, heading}));
    });
  });
}

/// All edges are open, and take as long as the grid says.
bool is_plain(const PoseGrid& grid, const continuous::Instance& instance, continuous::ClassId c) {
  const continuous::Roadmap& roadmap = instance.roadmap();
  for (const auto e : IdRange<continuous::EdgeId>(roadmap.num_edges())) {
    const continuous::Edge& edge = roadmap.edge(e);
    const bool is_turn = roadmap.position(edge.from) == roadmap.position(edge.to);
    if (!instance.may_use(c, e) || instance.duration(c, e) != (is_turn ? grid.turn() : Ticks(1)))
      return false;
  }
  return true;
}

bool are_plain(const PoseGrid& grid, const continuous::Instance& instance) {
  for (const AgentId i : instance.agent_ids())
    if (!is_plain(grid, instance.agent(i))) return false;
  for (const auto c : IdRange<continuous::ClassId>(instance.num_classes()))
    if (!is_plain(grid, instance, c)) return false;
  return true;
}

/// The same one, or an equal one.
bool is_roadmap_of(const PoseGrid& grid, const continuous::Roadmap& roadmap) {
  const continuous::Roadmap& own = *grid.roadmap();
  return &own == &roadmap ||
         (own.positions() == roadmap.positions() && own.edges() == roadmap.edges() &&
          roadmap.no_waiting().empty() && own.shapes() == roadmap.shapes());
}

bool is_known(const PoseGrid& grid, const continuous::Instance& instance) {
  return is_roadmap_of(grid, instance.roadmap()) && instance.now() == 0 &&
         instance.obstacles().empty() && grid.turn() <= Ticks(discrete::kMaxTurn) &&
         are_plain(grid, instance);
}

/// Requires that it is known. An error is why no two robots can do as they should.
Result<discrete::Instance> make_steps(const PoseGrid& grid, const continuous::Instance& instance) {
  auto graph = std::make_shared<const discrete::Graph>(cells_of(grid));
  const auto vertex = [&](VertexId pose) {
    return *graph->layout()->vertex_at(cell_of(grid, pose));
  };
  std::vector<discrete::Agent> agents;
  for (const continuous::Agent& agent : instance.agents()) {
    std::vector<VertexId> goals;
    for (const VertexId goal : agent.goals.vertices()) goals.push_back(vertex(goal));
    discrete::Agent& same =
        agents.emplace_back(discrete::Agent{vertex(agent.start), Goals(std::move(goals))});
    same.heading = grid.pose(agent.start).heading;
  }
  discrete::Rules rules;
  rules.turn = static_cast<Timestep>(grid.turn().value());
  return discrete::Instance::make(std::move(graph), std::move(agents), 0, std::move(rules));
}

/// What somebody does who is in the cells of a path, one timestep after the other.
continuous::Path in_poses(const PoseGrid& grid, const discrete::GridLayout& layout, Pose at,
                          const discrete::Path& path) {
  continuous::Path stops;
  const auto stop = [&](Ticks time) { stops.push_back({*grid.vertex(at), time, time}); };
  stop(0);
  for (std::size_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) continue;
    const discrete::Cell from = layout.cell_of(path[t - 1]), to = layout.cell_of(path[t]);
    const Heading ahead = heading_of_move(to.x - from.x, to.y - from.y);
    while (at.heading != ahead) {
      at.heading = at.heading == right_of(ahead) ? left_of(at.heading) : right_of(at.heading);
      stop(stops.back().depart + grid.turn());
    }
    const Ticks begin(static_cast<std::int64_t>(t) - 1);
    QUADRILLE_REQUIRE(stops.back().arrive <= begin, "there was time to turn");
    stops.back().depart = begin;
    at.cell = {to.x, to.y};
    stop(begin + 1);
  }
  return stops;
}

discrete::SolveOptions asked_in_steps(const PoseGrid& grid, const continuous::Instance& instance,
                                      const discrete::Instance& steps,
                                      const continuous::SolveOptions& options) {
  discrete::SolveOptions asked;
  static_cast<Choices&>(asked) = options;
  asked.limits = options.limits;
  asked.known_lower_bound = options.known_lower_bound;
  asked.on_progress = options.on_progress;
  asked.progress_interval_s = options.progress_interval_s;
  asked.plan_interval_s = options.plan_interval_s;
  if (options.on_plan)
    asked.on_plan = [&grid, &instance, tell = options.on_plan](const discrete::Plan& plan) {
      tell(in_ticks(grid, instance, plan));
    };
  asked.debug.audit = options.debug.audit;
  if (options.initial_plan) asked.initial_plan = in_steps(grid, steps, *options.initial_plan);
  if (options.debug.known_plan)
    asked.debug.known_plan = in_steps(grid, steps, *options.debug.known_plan);
  return asked;
}

/// Plans that are given, as continuous::solve asks for them.
std::optional<Error> refuse_given(const continuous::Instance& instance,
                                  const continuous::SolveOptions& options) {
  for (const auto& plan : {options.initial_plan, options.debug.known_plan}) {
    if (!plan) continue;
    const continuous::VerifyReport report = continuous::verify(instance, *plan);
    if (!report.valid())
      return Error{ErrorCode::invalid_plan, report.violations.front().message, {}};
  }
  return std::nullopt;
}

continuous::SolveOutcome told_in_ticks(const PoseGrid& grid, const continuous::Instance& instance,
                                       const discrete::Instance& steps,
                                       discrete::SolveOutcome outcome) {
  continuous::SolveOutcome told;
  told.status = outcome.status;
  told.cost = outcome.cost;
  told.lower_bound = outcome.lower_bound;
  told.rests_on_known_bound = outcome.rests_on_known_bound;
  told.stop = outcome.stop;
  told.explanation = std::move(outcome.explanation);
  told.blocked = std::move(outcome.blocked);
  const discrete::GridLayout& layout = *steps.graph().layout();
  for (const VertexId v : outcome.bottleneck)
    told.bottleneck.push_back(*grid.vertex(pose_of(layout.cell_of(v), Heading::east)));
  told.statistics = std::move(outcome.statistics);
  told.internal_error = std::move(outcome.internal_error);
  if (!outcome.plan) return told;
  told.plan = in_ticks(grid, instance, *outcome.plan);
  const continuous::VerifyReport report = continuous::verify(instance, *told.plan);
  if (report.valid()) return told;
  told.status = Status::unknown;
  told.plan.reset();
  told.cost.reset();
  told.internal_error =
      Error{ErrorCode::internal,
            "a plan in timesteps is none in ticks: " + report.violations.front().message,
            {}};
  return told;
}

}  // namespace

std::optional<discrete::Instance> in_steps(const PoseGrid& grid,
                                           const continuous::Instance& instance) {
  if (!is_known(grid, instance)) return std::nullopt;
  auto made = make_steps(grid, instance);
  return made ? std::optional(std::move(made).value()) : std::nullopt;
}

continuous::Plan in_ticks(const PoseGrid& grid, const continuous::Instance& instance,
                          const discrete::Plan& plan) {
  const discrete::Graph cells = cells_of(grid);
  continuous::Plan told;
  for (const AgentId i : instance.agent_ids())
    told.paths.push_back(
        in_poses(grid, *cells.layout(), grid.pose(instance.agent(i).start), plan.paths[i]));
  return told;
}

discrete::Plan in_steps(const PoseGrid& grid, const discrete::Instance& instance,
                        const continuous::Plan& plan) {
  discrete::Plan told;
  for (const continuous::Path& stops : plan.paths) {
    discrete::Path path;
    for (const continuous::Stop& stop : stops) {
      const VertexId v = *instance.graph().layout()->vertex_at(cell_of(grid, stop.vertex));
      // It is still where it was before until it arrives.
      const auto arrival = static_cast<std::size_t>(stop.arrive.value());
      if (!path.empty()) path.resize(std::max(path.size(), arrival), path.back());
      path.resize(static_cast<std::size_t>(stop.depart.value()) + 1, v);
    }
    told.paths.push_back(std::move(path));
  }
  discrete::trim(told);
  return told;
}

Result<continuous::SolveOutcome> solve(const PoseGrid& grid, const continuous::Instance& instance,
                                       const continuous::SolveOptions& options) {
  const bool is_asked =
      !options.explain && !options.proof && options.system == continuous::System::dpll;
  if (!is_asked || !is_known(grid, instance)) return continuous::solve(instance, options);
  const auto steps = make_steps(grid, instance);
  if (!steps) {
    continuous::SolveOutcome refused;
    refused.status = Status::infeasible;
    refused.explanation = steps.error().message;
    return refused;
  }
  if (steps->graph().num_vertices() > discrete::kMaxVertices)
    return continuous::solve(instance, options);
  if (auto error = refuse_given(instance, options)) return *std::move(error);
  auto outcome = discrete::solve(*steps, asked_in_steps(grid, instance, *steps, options));
  if (!outcome) return outcome.error();
  return told_in_ticks(grid, instance, *steps, std::move(outcome).value());
}

}  // namespace quadrille::poses
