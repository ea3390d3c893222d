// SPDX-License-Identifier: MIT
#include "routes/route_search.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>
#include <vector>

#include "routes/cost_floors.hpp"
#include "routes/route_orders.hpp"

namespace quadrille::continuous {
namespace {

/// What a move of a route counts, in comparisons.
constexpr std::int64_t kWorkPerMove = 20;
/// Longer routes are too many.
constexpr std::size_t kMaxMoves = 100;
/// The first step above the first bound is this part of it.
constexpr Cost kFirstStep = 16;

/// Lower bounds on what the agents of a subset cost together in every plan. Subsets are bit sets.
class SubsetBounds {
 public:
  SubsetBounds(Scene& scene, Objective objective) : objective_(objective) {
    const std::vector<Cost> floors = cost_floors(scene);
    bounds_.assign(std::size_t{1} << floors.size(), 0);
    for (std::size_t i = 0; i < floors.size(); ++i) bounds_[std::size_t{1} << i] = floors[i];
  }
  [[nodiscard]] Cost operator[](std::size_t subset) const { return bounds_[subset]; }
  [[nodiscard]] Cost joined(Cost a, Cost b) const {
    return objective_ == Objective::sum_of_costs ? a + b : std::max(a, b);
  }
  void raise(std::size_t subset, Cost bound) { bounds_[subset] = std::max(bounds_[subset], bound); }
  /// What its parts cost, if these are complete.
  void join_parts(std::size_t subset) {
    for (std::size_t part = (subset - 1) & subset; part > 0; part = (part - 1) & subset)
      raise(subset, joined(bounds_[part], bounds_[subset & ~part]));
  }

 private:
  const Objective objective_;
  std::vector<Cost> bounds_;
};

/// Cheapest plans of some of the agents.
class RouteSearch {
 public:
  /// `agents`: a subset, whose parts have bounds. The last two outlive this.
  RouteSearch(Scene& scene, Objective objective, std::size_t agents, const SubsetBounds& bounds,
              std::int64_t& work)
      : scene_(scene),
        instance_(scene.instance()),
        objective_(objective),
        all_(agents),
        bounds_(bounds),
        work_(work),
        orders_(scene, objective, work) {
    for (std::size_t i = 0; i < instance_.num_agents(); ++i)
      if ((agents >> i & 1) != 0) agents_.push_back(AgentId(i));
  }

  /// Until `work` is below 0, or the limits of the scene are met.
  RouteSearchReport run() {
    RouteSearchReport report{bounds_[all_], std::nullopt};
    Cost step = std::max<Cost>(bounds_[all_] / kFirstStep, 1);
    limit_ = bounds_[all_];
    std::int64_t last_work = 0;
    while (true) {
      if (limit_ > kAnyCost / 8) return report;  // without end
      limit_ += step;
      const std::int64_t before = work_;
      if (!list_routes()) return report;
      choose({});
      report.plan = std::move(plan_);
      if (is_over()) return report;
      report.lower_bound = limit_;  // lowered to the cost of the plan, if there is one
      if (report.plan) return report;
      // The work grows exponentially with the limit: by small factors, lest the last one is much
      // more than what it takes.
      const std::int64_t used = before - work_;
      if (used > 3 * last_work)
        step = std::max<Cost>(step / 2, 1);
      else
        step += step / 4 + 1;
      last_work = used;
    }
  }

 private:
  struct Traveller {
    AgentId agent;
    std::vector<Route> routes;  // by duration
  };
  /// Some of the travellers, and what they cost at least on the routes that are chosen for them.
  struct Part {
    std::size_t agents;
    Cost cost;
  };
  struct Chosen {
    std::vector<std::size_t> routes;  // of the first travellers
    std::vector<Part> parts{{0, 0}};  // all parts of them
  };

  [[nodiscard]] bool is_over() { return work_ < 0 || scene_.limits().exhausted(); }
  [[nodiscard]] static std::size_t bit(AgentId i) { return std::size_t{1} << i.index(); }
  [[nodiscard]] std::size_t bit(std::size_t k) const { return bit(travellers_[k].agent); }
  [[nodiscard]] std::size_t position(AgentId agent) const {
    return static_cast<std::size_t>(
        std::find_if(travellers_.begin(), travellers_.end(),
                     [agent](const Traveller& t) { return t.agent == agent; }) -
        travellers_.begin());
  }
  [[nodiscard]] const Route& route(std::size_t k, std::size_t r) const {
    return travellers_[k].routes[r];
  }
  /// Those of a subset cost less than this in plans below the limit.
  [[nodiscard]] Cost share(std::size_t subset) const {
    return objective_ == Objective::sum_of_costs ? limit_ - bounds_[all_ & ~subset] : limit_;
  }

  /// All routes that take less than the agent's share of the limit. The agent with the fewest comes
  /// first. False if that is too much work.
  bool list_routes() {
    travellers_.clear();
    for (const AgentId i : agents_) {
      Traveller& t = travellers_.emplace_back(Traveller{i, {}});
      Route route;
      extend(t, share(bit(i)), instance_.agent(i).start, route);
      if (is_over()) return false;
      std::stable_sort(t.routes.begin(), t.routes.end(),
                       [](const Route& a, const Route& b) { return a.duration < b.duration; });
    }
    std::stable_sort(travellers_.begin(), travellers_.end(), [](const auto& a, const auto& b) {
      return a.routes.size() < b.routes.size();
    });
    pairs_.clear();
    for (std::size_t k = 0; k < travellers_.size(); ++k) pairs_.emplace_back(k);
    return true;
  }

  void extend(Traveller& t, Cost share, VertexId v, Route& route) {
    if (route.edges.size() > kMaxMoves) work_ = -1;
    if (work_ < 0) return;
    if (v == instance_.agent(t.agent).goal()) {
      t.routes.push_back(route);
      work_ -= kWorkPerMove * static_cast<std::int64_t>(route.edges.size());
    }
    for (const EdgeId e : instance_.out_edges(instance_.class_of(t.agent), v)) {
      work_ -= kWorkPerMove;
      const VertexId to = instance_.roadmap().to(e);
      const Ticks wait = route.edges.empty() ? instance_.agent(t.agent).release : Ticks{0};
      const Ticks duration = wait + instance_.duration(instance_.class_of(t.agent), e);
      const Ticks to_go = scene_.task(t.agent).distances[to];
      if (to_go >= kForever) continue;
      const Ticks arrival = route.duration + duration + to_go;
      if (as_cost(arrival) >= share || arrival >= arrival_bound(instance_, t.agent)) continue;
      route.edges.push_back(e);
      route.duration += duration;
      extend(t, share, to, route);
      route.duration -= duration;
      route.edges.pop_back();
    }
  }

  void choose(const Chosen& chosen) {
    const std::size_t k = chosen.routes.size();
    if (k == travellers_.size()) return find_orders(chosen);
    for (std::size_t r = 0; r < travellers_[k].routes.size() && !is_over(); ++r) {
      Cost least = 0;
      for (const Part& part : chosen.parts)
        least = std::max(least, whole_cost(with_route(part, k, r)));
      if (least >= limit_) break;  // those that follow take longer
      Chosen next = chosen;
      if (add_route(next, r)) choose(next);
    }
  }

  [[nodiscard]] Part with_route(const Part& part, std::size_t k, std::size_t r) const {
    const std::size_t agents = part.agents | bit(k);
    return {agents,
            std::max(bounds_.joined(part.cost, as_cost(route(k, r).duration)), bounds_[agents])};
  }

  /// What all cost at least.
  [[nodiscard]] Cost whole_cost(const Part& part) const {
    return bounds_.joined(part.cost, bounds_[all_ & ~part.agents]);
  }

  /// Chooses it for the next traveller; false if no plan below the limit has these routes.
  bool add_route(Chosen& chosen, std::size_t r) {
    const std::size_t k = chosen.routes.size();
    const std::size_t num_parts = chosen.parts.size();
    work_ -= static_cast<std::int64_t>(num_parts);
    for (std::size_t p = 0; p < num_parts; ++p)
      chosen.parts.push_back(with_route(chosen.parts[p], k, r));
    for (std::size_t other = 0; other < k; ++other) {
      const auto pair = pair_cost(other, chosen.routes[other], k, r);
      if (!pair) return false;
      for (std::size_t p = 0; p < num_parts; ++p) {
        if ((p >> other & 1) == 0) continue;
        const Part& rest = chosen.parts[p & ~(std::size_t{1} << other)];
        Part& joint = chosen.parts[num_parts + p];
        joint.cost = std::max(joint.cost, bounds_.joined(rest.cost, *pair));
        if (whole_cost(joint) >= limit_) return false;
      }
    }
    chosen.routes.push_back(r);
    return true;
  }

  std::optional<Cost> pair_cost(std::size_t i, std::size_t route_i, std::size_t j,
                                std::size_t route_j) {
    const std::size_t key = route_i * travellers_[j].routes.size() + route_j;
    const auto [place, is_new] = pairs_[j][i].try_emplace(key);
    if (is_new) {
      orders_.clear();
      orders_.add(travellers_[i].agent, route(i, route_i));
      orders_.add(travellers_[j].agent, route(j, route_j));
      place->second = orders_.least(share(bit(i) | bit(j)));
    }
    return place->second;
  }

  void find_orders(const Chosen& chosen) {
    orders_.clear();
    for (std::size_t k = 0; k < travellers_.size(); ++k)
      orders_.add(travellers_[k].agent, route(k, chosen.routes[k]));
    const auto cost = orders_.least(limit_);
    if (!cost) return;
    limit_ = *cost;
    plan_.emplace();
    const std::vector<Path> paths = orders_.paths();
    for (const AgentId i : agents_) plan_->paths.push_back(paths[position(i)]);
  }

  Scene& scene_;
  const Instance& instance_;
  const Objective objective_;
  const std::size_t all_;
  const SubsetBounds& bounds_;
  std::int64_t& work_;
  std::vector<AgentId> agents_;
  Cost limit_ = 0;  // plans that cost less are looked for
  std::vector<Traveller> travellers_;
  /// By traveller, by one before it, by their routes: what they cost at least, if below their
  /// share.
  std::vector<std::vector<std::unordered_map<std::size_t, std::optional<Cost>>>> pairs_;
  RouteOrders orders_;
  std::optional<Plan> plan_;
};

}  // namespace

RouteSearchReport search_routes(Scene& scene, Objective objective, std::int64_t work) {
  const std::size_t size = scene.instance().num_agents();
  if (size == 0) return {0, Plan{}};
  SubsetBounds bounds(scene, objective);
  const std::size_t all = (std::size_t{1} << size) - 1;
  const std::int64_t work_per_part = work / 2 / static_cast<std::int64_t>(all);
  for (std::size_t agents = 1; agents < all; ++agents) {
    if (std::popcount(agents) < 2) continue;
    bounds.join_parts(agents);
    std::int64_t part_work = work_per_part;
    const auto report = RouteSearch(scene, objective, agents, bounds, part_work).run();
    bounds.raise(agents, report.lower_bound);
    work -= work_per_part - part_work;
  }
  bounds.join_parts(all);
  return RouteSearch(scene, objective, all, bounds, work).run();
}

}  // namespace quadrille::continuous
