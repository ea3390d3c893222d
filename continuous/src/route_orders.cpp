// SPDX-License-Identifier: MIT
#include "route_orders.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {

void RouteOrders::add(AgentId agent, const Route& route) {
  const Traveller added{agent, &route, size_};
  for (std::size_t k = 0; k < route.edges.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : size_ - 1;
    constraints_.push_back({before, size_++, k == 0 ? 0 : duration(added, k - 1)});
  }
  for (const Traveller& other : travellers_) {
    work_ -= static_cast<std::int64_t>((route.edges.size() + 1) * (other.route->edges.size() + 1));
    add_moves(other, added);
    add_stays(other, added);
    add_stays(added, other);
  }
  travellers_.push_back(added);
}

std::optional<Cost> RouteOrders::least(Cost limit) {
  limit_ = limit;
  best_.reset();
  branch(std::vector<Ticks>(size_, 0));
  if (!best_) return std::nullopt;
  return limit_;
}

std::vector<Path> RouteOrders::paths() const {
  std::vector<Path> paths;
  for (const Traveller& t : travellers_) {
    Path path{{instance_.agent(t.agent).start, 0, 0}};
    for (std::size_t k = 0; k < t.route->edges.size(); ++k) {
      path.back().depart = (*best_)[t.first + k];
      const Ticks arrive = path.back().depart + duration(t, k);
      path.push_back({instance_.roadmap().edge(t.route->edges[k]).to, arrive, arrive});
    }
    paths.push_back(path);
  }
  return paths;
}

void RouteOrders::add_moves(const Traveller& i, const Traveller& j) {
  for (std::size_t k = 0; k < i.route->edges.size(); ++k)
    for (std::size_t l = 0; l < j.route->edges.size(); ++l)
      if (const auto unsafe =
              contacts_.offsets(class_of(i), i.route->edges[k], class_of(j), j.route->edges[l]))
        choices_.push_back({Constraint{i.first + k, j.first + l, unsafe->hi + 1},
                            Constraint{j.first + l, i.first + k, -(unsafe->lo - 1)}});
}

// Stay number l of agent j is before its move number l.
void RouteOrders::add_stays(const Traveller& i, const Traveller& j) {
  for (std::size_t k = 0; k < i.route->edges.size(); ++k)
    for (std::size_t l = 0; l <= j.route->edges.size(); ++l) {
      const VertexId at = l == 0 ? instance_.agent(j.agent).start
                                 : instance_.roadmap().edge(j.route->edges[l - 1]).to;
      const auto window = contacts_.window(class_of(i), i.route->edges[k], class_of(j), at);
      if (!window) continue;
      const std::size_t move = i.first + k;
      // It arrives late enough, or leaves early enough.
      const std::size_t arrival = l == 0 ? 0 : j.first + l - 1;
      const Ticks travel = l == 0 ? 0 : duration(j, l - 1);
      Choice choice{{move, arrival, window->last - travel}, std::nullopt};
      if (l < j.route->edges.size()) choice.second = Constraint{j.first + l, move, -window->first};
      choices_.push_back(choice);
    }
}

/// Raises times to the least that the constraints allow; false if these contradict each other.
bool RouteOrders::tighten(std::vector<Ticks>& times) {
  for (std::size_t round = 0; round <= size_; ++round) {
    bool has_changed = false;
    work_ -= static_cast<std::int64_t>(constraints_.size());
    for (const Constraint& c : constraints_)
      if (times[c.to] < times[c.from] + c.gap) {
        if (c.to == 0) return false;
        times[c.to] = times[c.from] + c.gap;
        has_changed = true;
      }
    if (!has_changed) return true;
  }
  return false;
}

/// `times` are not later than any that are still possible.
void RouteOrders::branch(std::vector<Ticks> times) {
  if (work_ < 0 || !tighten(times)) return;
  work_ -= static_cast<std::int64_t>(choices_.size());
  const Cost cost = cost_of(times);
  if (cost >= limit_) return;
  const auto holds = [&](const Constraint& c) { return times[c.to] >= times[c.from] + c.gap; };
  const auto broken = std::find_if(choices_.begin(), choices_.end(), [&](const Choice& choice) {
    return !holds(choice.first) && !(choice.second && holds(*choice.second));
  });
  if (broken == choices_.end()) {
    limit_ = cost;
    best_ = std::move(times);
    return;
  }
  for (const auto& constraint : {std::optional(broken->first), broken->second}) {
    if (!constraint) continue;
    constraints_.push_back(*constraint);
    branch(times);
    constraints_.pop_back();
  }
}

Cost RouteOrders::cost_of(const std::vector<Ticks>& times) const {
  Cost total = 0;
  for (const Traveller& t : travellers_) {
    const std::size_t moves = t.route->edges.size();
    const Cost own = moves == 0 ? 0 : times[t.first + moves - 1] + duration(t, moves - 1);
    total = objective_ == Objective::sum_of_costs ? total + own : std::max(total, own);
  }
  return total;
}

}  // namespace quadrille::continuous
