// SPDX-License-Identifier: MIT
#include "routes/route_orders.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {

void RouteOrders::clear() {
  travellers_.clear();
  choices_.clear();
  chain_.assign(1, 0);
  earliest_.assign(1, 0);
}

void RouteOrders::add(AgentId agent, const Route& route) {
  const Traveller added{agent, &route, chain_.size()};
  for (std::size_t k = 0; k < route.edges.size(); ++k) {
    chain_.push_back(k + 1 == route.edges.size() ? Ticks{0} : duration(added, k));
    earliest_.push_back(instance_.agent(agent).release);
  }
  for (const Traveller& other : travellers_) {
    work_ -= static_cast<std::int64_t>((route.edges.size() + 1) * (other.route->edges.size() + 1));
    add_moves(other, added);
    add_stays(other, added);
    add_stays(added, other);
  }
  add_bans(added);
  travellers_.push_back(added);
}

std::optional<Cost> RouteOrders::least(Cost limit) {
  limit_ = limit;
  best_.reset();
  chosen_.clear();
  if (stack_.empty()) stack_.emplace_back();
  stack_.front() = earliest_;
  for (std::size_t v = 0; v + 1 < chain_.size(); ++v)
    if (chain_[v] > 0)
      stack_.front()[v + 1] = std::max(earliest_[v + 1], stack_.front()[v] + chain_[v]);
  branch(0);
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
      if (const auto& unsafe =
              contacts_.offsets(class_of(i), i.route->edges[k], class_of(j), j.route->edges[l]))
        choices_.push_back({Constraint{i.first + k, j.first + l, unsafe->end},
                            Constraint{j.first + l, i.first + k, unsafe->mirrored().end}});
}

// Stay number l of agent j is before its move number l.
void RouteOrders::add_stays(const Traveller& i, const Traveller& j) {
  for (std::size_t k = 0; k < i.route->edges.size(); ++k)
    for (std::size_t l = 0; l < j.route->edges.size() + (leaves(j) ? 0 : 1); ++l) {
      const VertexId at = l == 0 ? instance_.agent(j.agent).start
                                 : instance_.roadmap().edge(j.route->edges[l - 1]).to;
      const auto& window = contacts_.window(class_of(i), i.route->edges[k], class_of(j), at);
      if (!window) continue;
      const std::size_t move = i.first + k;
      // It arrives late enough, or leaves early enough.
      const std::size_t arrival = l == 0 ? 0 : j.first + l - 1;
      const Ticks travel = l == 0 ? Ticks{0} : duration(j, l - 1);
      Choice choice{{move, arrival, window->end - travel}, std::nullopt};
      if (l < j.route->edges.size()) choice.second = Constraint{j.first + l, move, -window->begin};
      choices_.push_back(choice);
    }
}

void RouteOrders::add_bans(const Traveller& t) {
  const std::vector<EdgeId>& edges = t.route->edges;
  for (const Ban& ban : scene_.standing_bans(t.agent)) {
    work_ -= static_cast<std::int64_t>(edges.size() + 1);
    if (ban.kind == Ban::Kind::start) {
      for (std::size_t k = 0; k < edges.size(); ++k)
        if (edges[k].value() == ban.place) add_start_ban(t.first + k, ban.when);
      continue;
    }
    if (instance_.agent(t.agent).start.value() == ban.place) add_stay_ban(t, 0, ban.when);
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (instance_.roadmap().edge(edges[k]).to.value() == ban.place)
        add_stay_ban(t, k + 1, ban.when);
  }
}

void RouteOrders::add_start_ban(std::size_t move, const TickInterval& starts) {
  const Constraint before{move, 0, 1 - starts.begin};
  if (starts.end >= kForever)
    choices_.push_back({before, std::nullopt});
  else
    choices_.push_back({Constraint{0, move, starts.end}, before});
}

// It arrives when the stretch ends or later, or leaves when it begins or before. Stay 0 is at the
// start, from tick 0 on; the last one is without end, or without length if the agent leaves.
void RouteOrders::add_stay_ban(const Traveller& t, std::size_t stay, const TickInterval& stretch) {
  const std::size_t moves = t.route->edges.size();
  std::vector<Constraint> allowed;
  const std::size_t arrival = stay == 0 ? 0 : t.first + stay - 1;
  const Ticks travel = stay == 0 ? Ticks{0} : duration(t, stay - 1);
  if (stretch.end < kForever) allowed.push_back({0, arrival, stretch.end - travel});
  if (stay < moves)
    allowed.push_back({t.first + stay, 0, -stretch.begin});
  else if (leaves(t))
    allowed.push_back({arrival, 0, travel - stretch.begin});
  if (allowed.empty()) allowed.push_back({0, 0, 1});  // it cannot be
  choices_.push_back({allowed[0], allowed.size() > 1 ? std::optional(allowed[1]) : std::nullopt});
}

/// Raises times, the least that the constraints before allowed, to the least that `added` allows
/// too; false if these contradict each other. They do if its own first variable has to be raised: a
/// cycle of constraints that are too long together goes through `added`, and the cycle is found the
/// first time around.
bool RouteOrders::enforce(const Constraint& added, Times& times) {
  to_follow_.clear();
  const auto raise = [&](std::size_t v, Ticks least) {
    if (times[v] >= least) return true;
    if (v == 0 || v == added.from) return false;
    times[v] = least;
    to_follow_.push_back(v);
    return true;
  };
  if (!raise(added.to, times[added.from] + added.gap)) return false;
  for (std::size_t next = 0; next < to_follow_.size(); ++next) {
    const std::size_t v = to_follow_[next];
    work_ -= static_cast<std::int64_t>(chosen_.size() + 1);
    if (chain_[v] > 0 && !raise(v + 1, times[v] + chain_[v])) return false;
    for (const Constraint& c : chosen_)
      if (c.from == v && !raise(c.to, times[v] + c.gap)) return false;
  }
  return true;
}

bool RouteOrders::is_late(const Times& times) const {
  return std::any_of(travellers_.begin(), travellers_.end(), [&](const Traveller& t) {
    const std::size_t moves = t.route->edges.size();
    return moves > 0 &&
           times[t.first + moves - 1] + duration(t, moves - 1) >= arrival_bound(instance_, t.agent);
  });
}

/// The times at `depth` are not later than any that are still possible.
void RouteOrders::branch(std::size_t depth) {
  work_ -= static_cast<std::int64_t>(choices_.size());
  if (work_ < 0) return;
  const Cost cost = cost_of(stack_[depth]);
  if (cost >= limit_ || is_late(stack_[depth])) return;
  const auto holds = [&times = stack_[depth]](const Constraint& c) {
    return times[c.to] >= times[c.from] + c.gap;
  };
  const auto broken = std::find_if(choices_.begin(), choices_.end(), [&](const Choice& choice) {
    return !holds(choice.first) && !(choice.second && holds(*choice.second));
  });
  if (broken == choices_.end()) {
    limit_ = cost;
    best_ = stack_[depth];
    return;
  }
  if (stack_.size() == depth + 1) stack_.emplace_back();
  for (const auto& constraint : {std::optional(broken->first), broken->second}) {
    if (!constraint) continue;
    stack_[depth + 1] = stack_[depth];
    if (!enforce(*constraint, stack_[depth + 1])) continue;
    chosen_.push_back(*constraint);
    branch(depth + 1);
    chosen_.pop_back();
  }
}

Cost RouteOrders::cost_of(const std::vector<Ticks>& times) const {
  Cost total = 0;
  for (const Traveller& t : travellers_) {
    const std::size_t moves = t.route->edges.size();
    const Cost own = moves == 0 ? 0 : as_cost(times[t.first + moves - 1] + duration(t, moves - 1));
    total = objective_ == Objective::sum_of_costs ? total + own : std::max(total, own);
  }
  return total;
}

}  // namespace quadrille::continuous
