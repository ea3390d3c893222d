// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/grid_dispatcher.hpp"

#include <algorithm>
#include <deque>
#include <set>
#include <string>
#include <utility>

#include "open_task.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/discrete/components.hpp"
#include "quadrille/discrete/rolling_planner.hpp"

namespace quadrille::dispatch {
namespace {

using discrete::Graph;

/// No time of a task is longer.
constexpr Ticks kMostService = 1'000'000'000;

/// Both ways.
Graph::Edge edge_of(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }
std::string edge_name(const Graph& graph, const Graph::Edge& edge) {
  return "the edge between " + vertex_name(graph, edge.first) + " and " +
         vertex_name(graph, edge.second);
}

}  // namespace

class GridDispatcher::Parts {
 public:
  Parts(std::shared_ptr<const Graph> graph, std::span<const VertexId> places,
        const GridOptions& options)
      : options_(options),
        graph_(std::move(graph)),
        whole_(discrete::components_of(*graph_)),
        parts_(whole_),
        planner_(graph_, places, {options.window, options.seed, options.improves}),
        robots_(places.size()) {}

  [[nodiscard]] std::size_t num_robots() const { return robots_.size(); }
  [[nodiscard]] const discrete::RollingPlanner& planner() const { return planner_; }
  [[nodiscard]] std::size_t num_tasks(AgentId i) const {
    return robots_.at(i.index()).tasks.size();
  }

  std::optional<Error> assign(AgentId i, const Task& task) {
    if (auto error = refuse_task(i, robots_.size(), task, kMostService)) return error;
    std::vector<VertexId> goals;
    for (const VertexId v : task.goals.vertices()) {
      if (v.index() >= graph_->num_vertices())
        return invalid(robot_name(i) + " is sent to vertex " + std::to_string(v.index()) +
                       ", but there are " + std::to_string(graph_->num_vertices()) + " vertices");
      if (are_joined(whole_, v, planner_.place(i))) goals.push_back(v);
    }
    if (goals.empty())
      return invalid("there is no way for " + robot_name(i) + " from " +
                     vertex_name(*graph_, planner_.place(i)) + " to where it is sent");
    Task reachable = task;
    reachable.goals = Goals(std::move(goals));
    Robot& robot = robots_[i.index()];
    robot.tasks.push_back({std::move(reachable), num_assigned_++});
    if (!robot.is_sent) send(i);
    return std::nullopt;
  }

  /// All edges at once, so that paths are made anew once.
  std::optional<Error> close(VertexId a, VertexId b) {
    if (auto error = refuse_edge(a, b)) return error;
    if (!closed_.insert(edge_of(a, b)).second)
      return invalid(edge_name(*graph_, edge_of(a, b)) + " is closed already");
    is_changed_ = true;
    return std::nullopt;
  }
  std::optional<Error> open(VertexId a, VertexId b) {
    if (auto error = refuse_edge(a, b)) return error;
    if (closed_.erase(edge_of(a, b)) == 0)
      return invalid(edge_name(*graph_, edge_of(a, b)) + " is not closed");
    is_changed_ = true;
    return std::nullopt;
  }

  void cancel(AgentId i) {
    robots_[i.index()] = {};
    planner_.release(i);
  }

  [[nodiscard]] execution::Precedences order() const {
    discrete::Plan plan;
    plan.now = planner_.now();
    std::vector<discrete::Agent> agents;
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      plan.paths.push_back(planner_.path(AgentId(k)));
      const discrete::Path& path = plan.paths[AgentId(k)];
      agents.push_back({path.front(), path.back()});
    }
    const auto instance = discrete::Instance::make(graph_, std::move(agents), plan.now);
    QUADRILLE_REQUIRE(instance.has_value(), "all are in vertices of their own, also at the end");
    auto order = execution::precedences(*instance, plan);
    QUADRILLE_REQUIRE(order.has_value(), "what is planned does not collide");
    return std::move(order).value();
  }

  News tick(std::span<const AgentId> held, const Limits& limits) {
    News news;
    if (std::exchange(is_changed_, false)) change_graph();
    for (std::size_t k = 0; k < robots_.size(); ++k) finish(AgentId(k), news);
    news.effort = planner_.plan(options_.effort, limits);
    news.has_new_plan = true;
    news.num_sent = std::exchange(num_sent_, 0);
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      const AgentId i(k);
      if (robots_[k].tasks.empty()) continue;
      if (!robots_[k].is_sent || !planner_.arrives(i)) {
        ++news.num_waiting;
        continue;
      }
      news.cost += planner_.cost(i);
      news.lower_bound += planner_.free_cost(i);
    }
    planner_.advance(held);
    return news;
  }

 private:
  struct Robot {
    std::deque<OpenTask> tasks;
    bool is_sent = false;  // about the first of them
  };

  /// The earliest deadline first, then the earliest assignment.
  [[nodiscard]] static std::int64_t rank(const OpenTask& open) {
    constexpr std::int64_t kWithoutDeadline = std::int64_t{1} << 62;
    return open.task.deadline ? open.task.deadline->value() : kWithoutDeadline + open.number;
  }

  [[nodiscard]] static bool are_joined(const Grouping& components, VertexId a, VertexId b) {
    return components.root(a.index()) == components.root(b.index());
  }
  [[nodiscard]] std::optional<Error> refuse_edge(VertexId a, VertexId b) const {
    const std::size_t n = graph_->num_vertices();
    if (a.index() < n && b.index() < n && graph_->adjacent(a, b)) return std::nullopt;
    return invalid("there is no edge between vertices " + std::to_string(a.index()) + " and " +
                   std::to_string(b.index()));
  }
  /// Whether it is at one of the goals of its first task, or can get there.
  [[nodiscard]] bool can_serve(AgentId i) const {
    const auto& goals = robots_[i.index()].tasks.front().task.goals.vertices();
    return std::any_of(goals.begin(), goals.end(),
                       [&](VertexId v) { return are_joined(parts_, v, planner_.place(i)); });
  }

  void change_graph() {
    std::vector<Graph::Edge> edges;
    for (const VertexId v : IdRange<VertexId>(graph_->num_vertices()))
      for (const VertexId w : graph_->neighbours(v))
        if (v < w && !closed_.contains({v, w})) edges.emplace_back(v, w);
    const auto graph =
        std::make_shared<const Graph>(Graph::make(graph_->num_vertices(), edges).value());
    parts_ = discrete::components_of(*graph);
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      Robot& robot = robots_[k];
      if (!robot.is_sent || can_serve(AgentId(k))) continue;
      robot.is_sent = false;
      planner_.release(AgentId(k));
    }
    planner_.set_graph(graph);
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (!robots_[k].tasks.empty() && !robots_[k].is_sent) send(AgentId(k));
  }

  void finish(AgentId i, News& news) {
    Robot& robot = robots_[i.index()];
    // It may be where its next task is already.
    while (robot.is_sent && planner_.is_done(i)) {
      news.served.push_back(i);
      robot.tasks.pop_front();
      robot.is_sent = false;
      if (robot.tasks.empty())
        planner_.release(i);
      else
        send(i);
    }
  }
  /// If it can get there.
  void send(AgentId i) {
    if (!can_serve(i)) return planner_.release(i);
    Robot& robot = robots_[i.index()];
    const OpenTask& open = robot.tasks.front();
    planner_.send(i, open.task.goals, static_cast<Timestep>(open.task.service.value()), rank(open));
    robot.is_sent = true;
    ++num_sent_;
  }

  const GridOptions options_;
  const std::shared_ptr<const Graph> graph_;
  const Grouping whole_;  // its components
  Grouping parts_;        // those without the edges that are closed
  std::set<Graph::Edge> closed_;
  bool is_changed_ = false;  // since the last call
  discrete::RollingPlanner planner_;
  std::vector<Robot> robots_;
  std::int64_t num_assigned_ = 0;
  std::size_t num_sent_ = 0;  // since the last call
};

Result<GridDispatcher> GridDispatcher::make(std::shared_ptr<const Graph> graph,
                                            std::vector<VertexId> places,
                                            const GridOptions& options) {
  QUADRILLE_REQUIRE(graph != nullptr, "a dispatcher has a graph");
  if (options.window < 1) return out_of_range("a window has at least one timestep");
  if (graph->is_directed()) return invalid("fleets on graphs with one-way edges are not supported");
  std::vector<std::optional<std::size_t>> who(graph->num_vertices());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].index() >= graph->num_vertices())
      return invalid(robot_name(AgentId(i)) + " is at vertex " + std::to_string(places[i].index()) +
                     ", but there are " + std::to_string(graph->num_vertices()) + " vertices");
    std::optional<std::size_t>& other = who[places[i].index()];
    if (other)
      return invalid("robots " + std::to_string(*other) + " and " + std::to_string(i) +
                     " are both at " + vertex_name(*graph, places[i]));
    other = i;
  }
  return GridDispatcher(std::make_unique<Parts>(std::move(graph), places, options));
}

GridDispatcher::GridDispatcher(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
GridDispatcher::~GridDispatcher() = default;
GridDispatcher::GridDispatcher(GridDispatcher&&) noexcept = default;
GridDispatcher& GridDispatcher::operator=(GridDispatcher&&) noexcept = default;

std::size_t GridDispatcher::num_robots() const noexcept { return parts_->num_robots(); }

std::optional<Error> GridDispatcher::assign(AgentId robot, const Task& task) {
  return parts_->assign(robot, task);
}

std::optional<Error> GridDispatcher::close(VertexId a, VertexId b) { return parts_->close(a, b); }
std::optional<Error> GridDispatcher::open(VertexId a, VertexId b) { return parts_->open(a, b); }

std::optional<Error> GridDispatcher::cancel(AgentId robot) {
  if (robot.index() >= num_robots()) return invalid("there is no " + robot_name(robot));
  parts_->cancel(robot);
  return std::nullopt;
}

News GridDispatcher::tick(std::span<const AgentId> held, const Limits& limits) {
  for (const AgentId robot : held)
    QUADRILLE_REQUIRE(robot.index() < num_robots(), "a robot of this fleet");
  return parts_->tick(held, limits);
}

VertexId GridDispatcher::place(AgentId robot) const { return parts_->planner().place(robot); }
discrete::Path GridDispatcher::path(AgentId robot) const { return parts_->planner().path(robot); }
execution::Precedences GridDispatcher::order() const { return parts_->order(); }
Timestep GridDispatcher::now() const noexcept { return parts_->planner().now(); }
std::size_t GridDispatcher::num_tasks(AgentId robot) const { return parts_->num_tasks(robot); }

}  // namespace quadrille::dispatch
