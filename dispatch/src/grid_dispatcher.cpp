// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/grid_dispatcher.hpp"

#include <deque>
#include <string>
#include <utility>

#include "quadrille/core/contract.hpp"
#include "quadrille/discrete/rolling_planner.hpp"

namespace quadrille::dispatch {
namespace {

using discrete::Graph;

/// No time of a task is longer.
constexpr Timestep kMostService = 1'000'000'000;

std::string name(AgentId robot) { return "robot " + std::to_string(robot.index()); }
Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

/// By vertex: two have the same number if there is a way from one to the other.
std::vector<std::size_t> components(const Graph& graph) {
  constexpr std::size_t kNone = SIZE_MAX;
  std::vector<std::size_t> numbers(graph.num_vertices(), kNone);
  std::vector<VertexId> found;
  for (std::size_t s = 0; s < graph.num_vertices(); ++s) {
    if (numbers[s] != kNone) continue;
    numbers[s] = s;
    found.assign(1, VertexId(s));
    while (!found.empty()) {
      const VertexId v = found.back();
      found.pop_back();
      for (const VertexId w : graph.neighbours(v)) {
        if (numbers[w.index()] != kNone) continue;
        numbers[w.index()] = s;
        found.push_back(w);
      }
    }
  }
  return numbers;
}

}  // namespace

class GridDispatcher::Parts {
 public:
  Parts(std::shared_ptr<const Graph> graph, std::span<const VertexId> places,
        const GridOptions& options)
      : options_(options),
        graph_(std::move(graph)),
        components_(components(*graph_)),
        planner_(graph_, places, {options.window, options.seed}),
        robots_(places.size()) {}

  [[nodiscard]] std::size_t num_robots() const { return robots_.size(); }
  [[nodiscard]] const discrete::RollingPlanner& planner() const { return planner_; }
  [[nodiscard]] std::size_t num_tasks(AgentId i) const {
    return robots_.at(i.index()).tasks.size();
  }

  std::optional<Error> assign(AgentId i, const Task& task) {
    if (i.index() >= robots_.size()) return invalid("there is no " + name(i));
    if (task.service < 0 || task.service > kMostService || (task.deadline && *task.deadline < 0))
      return out_of_range("the task of " + name(i) + " has a time that is negative or too long");
    std::vector<VertexId> goals;
    for (const VertexId v : task.goals.vertices()) {
      if (v.index() >= graph_->num_vertices())
        return invalid(name(i) + " is sent to vertex " + std::to_string(v.index()) +
                       ", but there are " + std::to_string(graph_->num_vertices()) + " vertices");
      if (components_[v.index()] == components_[planner_.place(i).index()]) goals.push_back(v);
    }
    if (goals.empty())
      return invalid("there is no way for " + name(i) + " from " +
                     vertex_name(*graph_, planner_.place(i)) + " to where it is sent");
    Task reachable = task;
    reachable.goals = Goals(std::move(goals));
    Robot& robot = robots_[i.index()];
    robot.tasks.push_back({std::move(reachable), num_assigned_++});
    if (!robot.is_sent) send(i);
    return std::nullopt;
  }

  void cancel(AgentId i) {
    robots_[i.index()] = {};
    planner_.release(i);
  }

  News tick(std::span<const AgentId> held, const Limits& limits) {
    News news;
    for (std::size_t k = 0; k < robots_.size(); ++k) finish(AgentId(k), news);
    news.effort = planner_.plan(options_.effort, limits);
    news.has_new_plan = true;
    news.num_sent = std::exchange(num_sent_, 0);
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      const AgentId i(k);
      if (robots_[k].tasks.empty()) continue;
      if (!planner_.arrives(i)) {
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
  struct Open {
    Task task;
    std::int64_t number = 0;  // in the order of assignments
  };
  struct Robot {
    std::deque<Open> tasks;
    bool is_sent = false;  // about the first of them
  };

  /// The earliest deadline first, then the earliest assignment.
  [[nodiscard]] static std::int64_t rank(const Open& open) {
    constexpr std::int64_t kWithoutDeadline = std::int64_t{1} << 62;
    return open.task.deadline ? open.task.deadline->value() : kWithoutDeadline + open.number;
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
  void send(AgentId i) {
    Robot& robot = robots_[i.index()];
    const Open& open = robot.tasks.front();
    planner_.send(i, open.task.goals, static_cast<Timestep>(open.task.service.value()), rank(open));
    robot.is_sent = true;
    ++num_sent_;
  }

  const GridOptions options_;
  const std::shared_ptr<const Graph> graph_;
  const std::vector<std::size_t> components_;
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
      return invalid(name(AgentId(i)) + " is at vertex " + std::to_string(places[i].index()) +
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

std::optional<Error> GridDispatcher::cancel(AgentId robot) {
  if (robot.index() >= num_robots()) return invalid("there is no " + name(robot));
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
Timestep GridDispatcher::now() const noexcept { return parts_->planner().now(); }
std::size_t GridDispatcher::num_tasks(AgentId robot) const { return parts_->num_tasks(robot); }

}  // namespace quadrille::dispatch
