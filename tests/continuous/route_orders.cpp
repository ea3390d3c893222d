// SPDX-License-Identifier: MIT
#include "route_orders.hpp"

#include <algorithm>

namespace quadrille::continuous::test {

geometry::BodyPair Meetings::pair(ClassId a, ClassId b) const {
  return {geometry::Disc{instance_.radius(a)}, geometry::Disc{instance_.radius(b)}};
}

const std::optional<geometry::OffsetInterval>& Meetings::offsets(ClassId a, EdgeId e, ClassId b,
                                                                 EdgeId f) {
  const auto [place, is_new] =
      offsets_.try_emplace(Key{a.index(), e.index(), b.index(), f.index()});
  if (is_new)
    place->second = pair(a, b).unsafe_offsets(instance_.motion(a, e), instance_.motion(b, f));
  return place->second;
}

const std::optional<geometry::ContactWindow>& Meetings::window(ClassId a, EdgeId e, ClassId b,
                                                               VertexId v) {
  const auto [place, is_new] =
      windows_.try_emplace(Key{a.index(), e.index(), b.index(), v.index()});
  if (is_new)
    place->second =
        pair(a, b).contact_window(instance_.motion(a, e), instance_.roadmap().position(v));
  return place->second;
}

void RouteOrders::add(AgentId agent, const Route& route) {
  const Traveller added{agent, &route, size_};
  for (std::size_t k = 0; k < route.edges.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : size_ - 1;
    constraints_.push_back({before, size_++, k == 0 ? 0 : duration(added, k - 1)});
  }
  for (const Traveller& other : travellers_) {
    add_moves(other, added);
    add_stays(other, added);
    add_stays(added, other);
  }
  travellers_.push_back(added);
}

void RouteOrders::visit(Cost limit, const Visit& visit) {
  limit_ = limit;
  branch(std::vector<Ticks>(size_, 0), visit);
}

std::optional<Cost> RouteOrders::least(Cost limit) {
  std::optional<Cost> best;
  visit(limit, [&](const std::vector<Ticks>&, Cost cost) {
    best = cost;
    return cost;
  });
  return best;
}

Plan RouteOrders::plan(const std::vector<Ticks>& times) const {
  const Instance& instance = meetings_.instance();
  Plan plan;
  for (const Traveller& t : travellers_) {
    Path path{{instance.agent(t.agent).start, 0, 0}};
    for (std::size_t k = 0; k < t.route->edges.size(); ++k) {
      path.back().depart = times[t.first + k];
      const Ticks arrive = path.back().depart + duration(t, k);
      path.push_back({instance.roadmap().edge(t.route->edges[k]).to, arrive, arrive});
    }
    plan.paths.push_back(path);
  }
  return plan;
}

ClassId RouteOrders::class_of(const Traveller& t) const {
  return meetings_.instance().class_of(t.agent);
}

Ticks RouteOrders::duration(const Traveller& t, std::size_t move) const {
  return meetings_.instance().duration(class_of(t), t.route->edges[move]);
}

void RouteOrders::add_moves(const Traveller& i, const Traveller& j) {
  for (std::size_t k = 0; k < i.route->edges.size(); ++k)
    for (std::size_t l = 0; l < j.route->edges.size(); ++l)
      if (const auto& unsafe =
              meetings_.offsets(class_of(i), i.route->edges[k], class_of(j), j.route->edges[l]))
        choices_.push_back({Constraint{i.first + k, j.first + l, unsafe->hi + 1},
                            Constraint{j.first + l, i.first + k, -(unsafe->lo - 1)}});
}

// Stay number l of agent j is before its move number l.
void RouteOrders::add_stays(const Traveller& i, const Traveller& j) {
  const Instance& instance = meetings_.instance();
  for (std::size_t k = 0; k < i.route->edges.size(); ++k)
    for (std::size_t l = 0; l <= j.route->edges.size(); ++l) {
      const VertexId at = l == 0 ? instance.agent(j.agent).start
                                 : instance.roadmap().edge(j.route->edges[l - 1]).to;
      const auto& window = meetings_.window(class_of(i), i.route->edges[k], class_of(j), at);
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
bool RouteOrders::tighten(std::vector<Ticks>& times) const {
  for (std::size_t round = 0; round <= size_; ++round) {
    bool has_changed = false;
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
void RouteOrders::branch(std::vector<Ticks> times, const Visit& visit) {
  if (!tighten(times)) return;
  const Cost cost = cost_of(times);
  if (cost >= limit_) return;
  const auto holds = [&](const Constraint& c) { return times[c.to] >= times[c.from] + c.gap; };
  const auto broken = std::find_if(choices_.begin(), choices_.end(), [&](const Choice& choice) {
    return !holds(choice.first) && !(choice.second && holds(*choice.second));
  });
  if (broken == choices_.end()) {
    limit_ = visit(times, cost);
    return;
  }
  for (const auto& constraint : {std::optional(broken->first), broken->second}) {
    if (!constraint) continue;
    constraints_.push_back(*constraint);
    branch(times, visit);
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

}  // namespace quadrille::continuous::test
