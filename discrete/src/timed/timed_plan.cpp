// SPDX-License-Identifier: MIT
#include "quadrille/discrete/timed_plan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "quadrille/discrete/verify.hpp"

namespace quadrille::discrete {

std::optional<GridPoint> grid_point(const Graph& graph, const Position& position) {
  if (!graph.layout()) return std::nullopt;
  const Cell from = graph.layout()->cell_of(position.from);
  const Cell to = graph.layout()->cell_of(position.to);
  return GridPoint{from.x + position.share * (to.x - from.x),
                   from.y + position.share * (to.y - from.y)};
}

Position TimedPath::at(double time) const {
  // The last stop that has begun; the first one before the plan begins.
  const auto later = std::upper_bound(stops_.begin() + 1, stops_.end(), time,
                                      [](double t, const Stop& stop) { return t < stop.arrive; });
  const Stop& stop = *std::prev(later);
  if (later == stops_.end() || time <= stop.depart) return {stop.vertex, stop.vertex, 0};
  // Each move takes one timestep.
  return {stop.vertex, later->vertex, time - stop.depart};
}

std::vector<Sample> TimedPath::samples(double rate) const {
  return samples(rate, stops_.back().arrive);
}

std::vector<Sample> TimedPath::samples(double rate, double until) const {
  QUADRILLE_REQUIRE(rate > 0 && std::isfinite(rate), "a positive rate");
  QUADRILLE_REQUIRE(std::isfinite(until), "an end");
  std::vector<Sample> samples;
  for (std::size_t k = 0;; ++k) {
    const double time = stops_.front().arrive + static_cast<double>(k) / rate;
    samples.push_back({time, at(time)});
    if (time >= until) return samples;
  }
}

std::vector<Wait> TimedPath::waits() const {
  std::vector<Wait> waits;
  for (const Stop& stop : stops_)
    if (stop.depart > stop.arrive) waits.push_back({stop.vertex, stop.arrive, stop.depart});
  return waits;
}

Result<TimedPlan> TimedPlan::make(const Instance& instance, const Plan& plan) {
  const VerifyReport report = verify(instance, plan);
  if (!report.valid()) return Error{ErrorCode::invalid_plan, report.violations.front().message, {}};
  auto paths = std::make_shared<IdVector<AgentId, TimedPath>>();
  TimedPlan timed;
  for (const AgentId i : instance.agent_ids()) {
    const Path& path = plan.paths[i];
    const auto end = static_cast<std::size_t>(arrival(path));
    TimedPath made;
    for (std::size_t t = 0; t <= end; ++t) {
      const Timestep step = plan.now + static_cast<Timestep>(t);
      if (t == 0 || path[t] != path[t - 1]) made.stops_.push_back({path[t], step, step});
      made.stops_.back().depart = step;
    }
    const Agent& agent = instance.agents()[i];
    made.free_cost_ = distances_to_nearest(instance.graph(), agent.goals)[agent.start];
    timed.delay_ += made.delay();
    paths->push_back(std::move(made));
  }
  timed.sum_of_costs_ = plan.cost(Objective::sum_of_costs);
  timed.makespan_ = plan.cost(Objective::makespan);
  timed.paths_ = std::move(paths);
  return timed;
}

}  // namespace quadrille::discrete
