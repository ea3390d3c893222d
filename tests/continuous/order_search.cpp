// SPDX-License-Identifier: MIT
#include "order_search.hpp"

#include <algorithm>
#include <functional>

#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous::test {
namespace {

using Route = std::vector<EdgeId>;

std::vector<Route> routes(const Instance& instance, AgentId i, std::size_t max_moves) {
  std::vector<Route> found;
  Route route;
  const std::function<void(VertexId)> walk = [&](VertexId v) {
    if (v == instance.agent(i).goal) found.push_back(route);
    if (route.size() == max_moves) return;
    for (const EdgeId e : instance.roadmap().out_edges(v)) {
      route.push_back(e);
      walk(instance.roadmap().edge(e).to);
      route.pop_back();
    }
  };
  walk(instance.agent(i).start);
  return found;
}

/// time[to] >= time[from] + gap. Variable 0 is tick 0, the others are starts of moves.
struct Constraint {
  std::size_t from, to;
  Ticks gap;
};

/// Earliest times, or nothing if they contradict each other.
std::optional<std::vector<Ticks>> earliest(std::size_t size, const std::vector<Constraint>& all) {
  std::vector<Ticks> time(size, 0);
  for (std::size_t round = 0; round <= size; ++round) {
    bool has_changed = false;
    for (const Constraint& c : all)
      if (time[c.to] < time[c.from] + c.gap) {
        if (c.to == 0) return std::nullopt;
        time[c.to] = time[c.from] + c.gap;
        has_changed = true;
      }
    if (!has_changed) return time;
  }
  return std::nullopt;
}

/// One of two constraints has to hold; the second one may be impossible.
struct Choice {
  Constraint first;
  std::optional<Constraint> second;
};

class RouteOrders {
 public:
  RouteOrders(const Instance& instance, Objective objective, const std::vector<Route>& routes,
              OrderSearch& result)
      : instance_(instance), objective_(objective), routes_(routes), result_(result) {
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      first_.push_back(size_);
      for (std::size_t k = 0; k < routes_[i].size(); ++k) {
        const std::size_t before = k == 0 ? 0 : size_ - 1;
        fixed_.push_back({before, size_++, k == 0 ? 0 : duration(i, k - 1)});
      }
    }
    for (std::size_t i = 0; i < routes_.size(); ++i)
      for (std::size_t j = 0; j < routes_.size(); ++j) {
        if (i < j) add_moves(i, j);
        if (i != j) add_stays(i, j);
      }
  }

  void search() {
    std::vector<Constraint> all = fixed_;
    branch(all);
  }

 private:
  ClassId class_of(std::size_t i) const { return instance_.class_of(AgentId(i)); }
  Ticks duration(std::size_t i, std::size_t k) const {
    return instance_.duration(class_of(i), routes_[i][k]);
  }
  geometry::BodyPair pair(std::size_t i, std::size_t j) const {
    return {geometry::Disc{instance_.agent(AgentId(i)).radius},
            geometry::Disc{instance_.agent(AgentId(j)).radius}};
  }

  void add_moves(std::size_t i, std::size_t j) {
    for (std::size_t k = 0; k < routes_[i].size(); ++k)
      for (std::size_t l = 0; l < routes_[j].size(); ++l)
        if (const auto unsafe =
                pair(i, j).unsafe_offsets(instance_.motion(class_of(i), routes_[i][k]),
                                          instance_.motion(class_of(j), routes_[j][l])))
          choices_.push_back({Constraint{first_[i] + k, first_[j] + l, unsafe->hi + 1},
                              Constraint{first_[j] + l, first_[i] + k, -(unsafe->lo - 1)}});
  }

  // Stay number l of agent j is before its move number l.
  void add_stays(std::size_t i, std::size_t j) {
    for (std::size_t k = 0; k < routes_[i].size(); ++k)
      for (std::size_t l = 0; l <= routes_[j].size(); ++l) {
        const VertexId at = l == 0 ? instance_.agent(AgentId(j)).start
                                   : instance_.roadmap().edge(routes_[j][l - 1]).to;
        const auto window = pair(i, j).contact_window(instance_.motion(class_of(i), routes_[i][k]),
                                                      instance_.roadmap().position(at));
        if (!window) continue;
        const std::size_t move = first_[i] + k;
        // It arrives late enough, or leaves early enough.
        const std::size_t arrival = l == 0 ? 0 : first_[j] + l - 1;
        const Ticks travel = l == 0 ? 0 : duration(j, l - 1);
        Choice choice{{move, arrival, window->last - travel}, std::nullopt};
        if (l < routes_[j].size()) choice.second = Constraint{first_[j] + l, move, -window->first};
        choices_.push_back(choice);
      }
  }

  void branch(std::vector<Constraint>& all) {
    const auto time = earliest(size_, all);
    if (!time) return;
    const Cost cost = cost_of(*time);
    if (result_.best && cost >= *result_.best && result_.some_plans.size() >= 10) return;
    const auto holds = [&](const Constraint& c) {
      return (*time)[c.to] >= (*time)[c.from] + c.gap;
    };
    for (const Choice& choice : choices_) {
      if (holds(choice.first) || (choice.second && holds(*choice.second))) continue;
      all.push_back(choice.first);
      branch(all);
      all.pop_back();
      if (choice.second) {
        all.push_back(*choice.second);
        branch(all);
        all.pop_back();
      }
      return;
    }
    keep(*time, cost);
  }

  Cost cost_of(const std::vector<Ticks>& time) const {
    Cost total = 0;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      const std::size_t moves = routes_[i].size();
      const Cost own = moves == 0 ? 0 : time[first_[i] + moves - 1] + duration(i, moves - 1);
      total = objective_ == Objective::sum_of_costs ? total + own : std::max(total, own);
    }
    return total;
  }

  void keep(const std::vector<Ticks>& time, Cost cost) {
    Plan plan;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      Path path{{instance_.agent(AgentId(i)).start, 0, 0}};
      for (std::size_t k = 0; k < routes_[i].size(); ++k) {
        path.back().depart = time[first_[i] + k];
        const Ticks arrive = path.back().depart + duration(i, k);
        path.push_back({instance_.roadmap().edge(routes_[i][k]).to, arrive, arrive});
      }
      plan.paths.push_back(path);
    }
    if (result_.some_plans.size() < 10) result_.some_plans.push_back(plan);
    if (result_.best && *result_.best <= cost) return;
    result_.best = cost;
    result_.best_plan = plan;
  }

  const Instance& instance_;
  const Objective objective_;
  const std::vector<Route>& routes_;
  OrderSearch& result_;
  std::size_t size_ = 1;
  std::vector<std::size_t> first_;  // by agent: the variable of its first move
  std::vector<Constraint> fixed_;
  std::vector<Choice> choices_;
};

}  // namespace

OrderSearch search_orders(const Instance& instance, Objective objective, std::size_t max_moves) {
  OrderSearch result;
  std::vector<std::vector<Route>> all;
  for (const AgentId i : instance.agent_ids()) all.push_back(routes(instance, i, max_moves));
  std::vector<Route> chosen;
  const std::function<void()> choose = [&] {
    if (chosen.size() == all.size()) {
      RouteOrders(instance, objective, chosen, result).search();
      return;
    }
    for (const Route& route : all[chosen.size()]) {
      chosen.push_back(route);
      choose();
      chosen.pop_back();
    }
  };
  choose();
  return result;
}

}  // namespace quadrille::continuous::test
