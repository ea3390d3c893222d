// SPDX-License-Identifier: MIT
#include "route_search.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "route_orders.hpp"

namespace quadrille::continuous {
namespace {

/// What a move of a route counts, in comparisons.
constexpr std::int64_t kWorkPerMove = 20;
/// Longer routes are too many.
constexpr std::size_t kMaxMoves = 100;

class RouteSearch {
 public:
  RouteSearch(Model& model, Objective objective, std::int64_t work)
      : model_(model), instance_(model.instance()), objective_(objective), work_(work) {
    const std::size_t size = instance_.num_agents();
    rest_.assign(size + 1, 0);
    for (std::size_t i = size; i-- > 0;)
      rest_[i] = joined(rest_[i + 1], model_.free_cost(AgentId(i)));
  }

  RouteSearchReport run() {
    RouteSearchReport report{rest_[0], std::nullopt};
    Cost step = std::max<Cost>(rest_[0] / 16, 1);
    while (true) {
      limit_ = rest_[0] + step;
      if (!list_routes()) return report;
      choose({});
      report.plan = std::move(plan_);
      if (is_over()) return report;
      report.lower_bound = limit_;  // lowered to the cost of the plan, if there is one
      if (report.plan) return report;
      step += step / 4 + 1;
      if (step > kForever / 8) return report;  // without end
    }
  }

 private:
  struct Chosen {
    std::vector<std::size_t> routes;  // of the first agents
    Cost durations = 0;               // sum or maximum
    Cost pairs = 0;                   // sum or maximum of what each two of them cost
  };

  [[nodiscard]] bool is_sum() const { return objective_ == Objective::sum_of_costs; }
  [[nodiscard]] Cost joined(Cost a, Cost b) const { return is_sum() ? a + b : std::max(a, b); }
  [[nodiscard]] bool is_over() { return work_ < 0 || model_.limits().exhausted(); }
  /// Agents who cost `free` without the others cost less than this in plans below the limit.
  [[nodiscard]] Cost share(Cost free) const {
    return is_sum() ? limit_ - (rest_[0] - free) : limit_;
  }

  /// All routes that take less than the agent's share of the limit. False if that is too much work.
  bool list_routes() {
    routes_.clear();
    pairs_.clear();
    for (const AgentId i : instance_.agent_ids()) {
      routes_.emplace_back();
      pairs_.emplace_back(i.index());
      Route route;
      extend(i, instance_.agent(i).start, route);
      if (is_over()) return false;
      std::stable_sort(routes_.back().begin(), routes_.back().end(),
                       [](const Route& a, const Route& b) { return a.duration < b.duration; });
    }
    return true;
  }

  void extend(AgentId i, VertexId v, Route& route) {
    if (route.edges.size() > kMaxMoves) work_ = -1;
    if (work_ < 0) return;
    if (v == instance_.agent(i).goal) {
      routes_.back().push_back(route);
      work_ -= kWorkPerMove * static_cast<std::int64_t>(route.edges.size());
    }
    const Cost share_of_agent = share(model_.free_cost(i));
    for (const EdgeId e : instance_.roadmap().out_edges(v)) {
      work_ -= kWorkPerMove;
      const VertexId to = instance_.roadmap().edge(e).to;
      const Ticks duration = instance_.duration(instance_.class_of(i), e);
      const Ticks to_go = model_.task(i).distances[to];
      if (to_go >= kForever || route.duration + duration + to_go >= share_of_agent) continue;
      route.edges.push_back(e);
      route.duration += duration;
      extend(i, to, route);
      route.duration -= duration;
      route.edges.pop_back();
    }
  }

  void choose(const Chosen& chosen) {
    const std::size_t agent = chosen.routes.size();
    if (agent == routes_.size()) return find_orders(chosen);
    for (std::size_t r = 0; r < routes_[agent].size() && !is_over(); ++r) {
      Chosen next = chosen;
      next.routes.push_back(r);
      next.durations = joined(chosen.durations, routes_[agent][r].duration);
      if (joined(next.durations, rest_[agent + 1]) >= limit_) break;
      if (add_pairs(next)) choose(next);
    }
  }

  /// For the agent chosen last; false if no plan below the limit has these routes.
  bool add_pairs(Chosen& chosen) {
    const std::size_t agent = chosen.routes.size() - 1;
    for (std::size_t other = 0; other < agent; ++other) {
      const auto cost = pair_cost(other, chosen.routes[other], agent, chosen.routes[agent]);
      if (!cost) return false;
      chosen.pairs = joined(chosen.pairs, *cost);
    }
    if (agent == 0) return true;
    if (!is_sum()) return chosen.pairs < limit_;
    // The sum over pairs has the cost of each agent once per other one.
    return chosen.pairs < (limit_ - rest_[agent + 1]) * static_cast<Cost>(agent);
  }

  std::optional<Cost> pair_cost(std::size_t i, std::size_t route_i, std::size_t j,
                                std::size_t route_j) {
    const auto [place, is_new] = pairs_[j][i].try_emplace({route_i, route_j});
    if (is_new) {
      RouteOrders orders(model_.contacts(), instance_, objective_, work_);
      orders.add(AgentId(i), routes_[i][route_i]);
      orders.add(AgentId(j), routes_[j][route_j]);
      place->second =
          orders.least(share(model_.free_cost(AgentId(i)) + model_.free_cost(AgentId(j))));
    }
    return place->second;
  }

  void find_orders(const Chosen& chosen) {
    RouteOrders orders(model_.contacts(), instance_, objective_, work_);
    for (std::size_t i = 0; i < routes_.size(); ++i)
      orders.add(AgentId(i), routes_[i][chosen.routes[i]]);
    const auto cost = orders.least(limit_);
    if (!cost) return;
    limit_ = *cost;
    plan_.emplace();
    for (Path& path : orders.paths()) plan_->paths.push_back(std::move(path));
  }

  Model& model_;
  const Instance& instance_;
  const Objective objective_;
  std::int64_t work_;
  std::vector<Cost> rest_;                  // by agent: what it and those after it cost at least
  Cost limit_ = 0;                          // plans that cost less are looked for
  std::vector<std::vector<Route>> routes_;  // by agent
  /// By agent, by one before it, by their routes: what they cost at least, if below their share.
  std::vector<std::vector<std::map<std::pair<std::size_t, std::size_t>, std::optional<Cost>>>>
      pairs_;
  std::optional<Plan> plan_;
};

}  // namespace

RouteSearchReport search_routes(Model& model, Objective objective, std::int64_t work) {
  if (model.instance().num_agents() == 0) return {0, Plan{}};
  return RouteSearch(model, objective, work).run();
}

}  // namespace quadrille::continuous
