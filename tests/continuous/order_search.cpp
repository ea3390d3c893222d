// SPDX-License-Identifier: MIT
#include "order_search.hpp"

#include <algorithm>
#include <functional>

#include "route_orders.hpp"

namespace quadrille::continuous::test {
namespace {

constexpr std::size_t kSomePlans = 10;

/// All of at most `max_moves` moves.
std::vector<Route> routes(const Instance& instance, AgentId i, std::size_t max_moves) {
  std::vector<Route> found;
  Route route;
  const std::function<void(VertexId)> walk = [&](VertexId v) {
    if (v == instance.agent(i).goal) found.push_back(route);
    if (route.edges.size() == max_moves) return;
    for (const EdgeId e : instance.roadmap().out_edges(v)) {
      const Ticks duration = instance.duration(instance.class_of(i), e);
      route.edges.push_back(e);
      route.duration += duration;
      walk(instance.roadmap().edge(e).to);
      route.duration -= duration;
      route.edges.pop_back();
    }
  };
  walk(instance.agent(i).start);
  return found;
}

/// One route per agent: all combinations, until some plans are known, and then those that may be
/// cheaper. What two agents cannot do, or not cheaply enough, is left out whatever the others do.
class Combinations {
 public:
  Combinations(const Instance& instance, Objective objective, std::size_t max_moves)
      : meetings_(instance), objective_(objective) {
    for (const AgentId i : instance.agent_ids()) {
      routes_.push_back(routes(instance, i, max_moves));
      pairs_.emplace_back();
      for (std::size_t j = 0; j < i.index(); ++j) pairs_.back().emplace_back();
    }
  }

  OrderSearch search() {
    for (const auto& routes : routes_)
      if (routes.empty()) return result_;
    choose({});
    if (result_.some_plans.size() < kSomePlans) return result_;  // these are all
    for (auto& routes : routes_)
      std::stable_sort(routes.begin(), routes.end(),
                       [](const Route& a, const Route& b) { return a.duration < b.duration; });
    for (auto& of_agent : pairs_)
      for (auto& pairs : of_agent) pairs.clear();
    limit_ = *result_.best;
    choose({});
    return result_;
  }

 private:
  struct Chosen {
    std::vector<std::size_t> routes;  // by agent, of the first ones
    Cost durations = 0;               // sum or maximum
    Cost pairs = 0;                   // sum or maximum of what each two of them cost
  };

  [[nodiscard]] Cost joined(Cost a, Cost b) const {
    return objective_ == Objective::sum_of_costs ? a + b : std::max(a, b);
  }
  /// What the agents from this one on cost at least.
  [[nodiscard]] Cost rest(std::size_t agent) const {
    Cost total = 0;
    for (; agent < routes_.size(); ++agent) {
      Cost least = RouteOrders::kNoLimit;
      for (const Route& route : routes_[agent]) least = std::min(least, route.duration);
      total = joined(total, least);
    }
    return total;
  }

  void choose(const Chosen& chosen) {
    const std::size_t agent = chosen.routes.size();
    if (agent == routes_.size()) return find_orders(chosen);
    const Cost rest_cost = rest(agent + 1);
    for (std::size_t r = 0; r < routes_[agent].size(); ++r) {
      Chosen next = chosen;
      next.routes.push_back(r);
      next.durations = joined(chosen.durations, routes_[agent][r].duration);
      if (joined(next.durations, rest_cost) >= limit_) continue;
      if (add_pairs(next, rest_cost)) choose(next);
    }
  }

  /// For the agent chosen last; false if the choice is no good.
  bool add_pairs(Chosen& chosen, Cost rest_cost) {
    if (routes_.size() == 2) return true;  // would do the work twice
    const std::size_t agent = chosen.routes.size() - 1;
    for (std::size_t other = 0; other < agent; ++other) {
      const auto cost = pair_cost(other, chosen.routes[other], agent, chosen.routes[agent]);
      if (!cost) return false;
      chosen.pairs = joined(chosen.pairs, *cost);
    }
    // A sum has the cost of each of them once per other agent.
    const bool is_sum = objective_ == Objective::sum_of_costs;
    if (agent == 0 || limit_ == RouteOrders::kNoLimit) return true;
    if (!is_sum) return chosen.pairs < limit_;
    return chosen.pairs < (limit_ - rest_cost) * static_cast<Cost>(agent);
  }

  std::optional<Cost> pair_cost(std::size_t i, std::size_t route_i, std::size_t j,
                                std::size_t route_j) {
    const auto [place, is_new] = pairs_[j][i].try_emplace({route_i, route_j});
    if (is_new) {
      RouteOrders orders(meetings_, objective_);
      orders.add(AgentId(i), routes_[i][route_i]);
      orders.add(AgentId(j), routes_[j][route_j]);
      place->second = orders.least(RouteOrders::kNoLimit);
    }
    return place->second;
  }

  void find_orders(const Chosen& chosen) {
    RouteOrders orders(meetings_, objective_);
    for (std::size_t i = 0; i < routes_.size(); ++i)
      orders.add(AgentId(i), routes_[i][chosen.routes[i]]);
    orders.visit(limit_, [&](const std::vector<Ticks>& times, Cost cost) {
      keep(orders.plan(times), cost);
      return limit_;
    });
  }

  void keep(const Plan& plan, Cost cost) {
    if (!result_.best || cost < *result_.best) {
      result_.best = cost;
      result_.best_plan = plan;
    }
    if (limit_ != RouteOrders::kNoLimit) {
      limit_ = *result_.best;
    } else {
      result_.some_plans.push_back(plan);
      if (result_.some_plans.size() == kSomePlans) limit_ = 0;  // enough of that
    }
  }

  Meetings meetings_;
  const Objective objective_;
  std::vector<std::vector<Route>> routes_;  // by agent
  /// By agent, by one before it, by their routes.
  std::vector<std::vector<std::map<std::pair<std::size_t, std::size_t>, std::optional<Cost>>>>
      pairs_;
  Cost limit_ = RouteOrders::kNoLimit;
  OrderSearch result_;
};

}  // namespace

OrderSearch search_orders(const Instance& instance, Objective objective, std::size_t max_moves) {
  return Combinations(instance, objective, max_moves).search();
}

}  // namespace quadrille::continuous::test
