// SPDX-License-Identifier: MIT
#include "ruled/ruled_plans.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace quadrille::discrete {
namespace {

/// Agents that give up their paths at a time.
constexpr std::size_t kMostAtOnce = 8;

/// From so much later on nothing changes any more, and who can arrive does.
Timestep horizon_of(const AgentDistances& distances) {
  const auto states = static_cast<std::int64_t>(distances.states().num_vertices());
  const auto most = std::min<std::int64_t>(kForever / 2, 2 * std::int64_t{kMaxRuleTime} + states);
  return distances.deadline().value_or(static_cast<Timestep>(most));
}

}  // namespace

RuledPlans::RuledPlans(const Instance& instance, const GoalDistances& distances,
                       Objective objective, std::uint32_t seed, LimitMonitor& limits)
    : instance_(instance),
      objective_(objective),
      blocked_(instance),
      random_(seed),
      search_(instance.graph().num_vertices(), &limits),
      map_(instance.graph().num_vertices()),
      paths_(instance.num_agents()) {
  const bool is_blocked = !instance.rules().blockages.empty();
  for (const AgentId i : instance.agent_ids()) {
    limits.check();
    distances_.push_back(
        AgentDistances(instance, distances, i, nullptr, is_blocked ? &blocked_ : nullptr));
    order_.push_back(i);
  }
  // Who has little time to spare first, then who has a long way.
  const auto spare = [&](AgentId i) {
    const auto deadline = distances_[i].deadline();
    return deadline ? *deadline - distances_[i].length() : kForever;
  };
  std::stable_sort(order_.begin(), order_.end(), [&](AgentId i, AgentId j) {
    return std::pair(spare(i), -distances_[i].length()) <
           std::pair(spare(j), -distances_[j].length());
  });
}

void RuledPlans::avoid(AgentId other) {
  const Timestep k = instance_.rules().robust;
  const Agent& task = instance_.agents()[other];
  const auto add = [&](VertexId v, Timestep first, Timestep last) {
    active_.push_back(table_.add_range(other, sat::Lit(), v, std::max(0, first - k),
                                       last == kForever ? kForever : last + k));
  };
  const Path& path = paths_[other];
  if (path.empty()) {
    // It is at its start, whatever it does then.
    const bool may_vanish = task.leaves && task.goals.contains(task.start);
    return add(task.start, 0, may_vanish ? 0 : task.release);
  }
  const auto end = static_cast<Timestep>(path.size()) - 1;
  for (Timestep t = 0; t <= end;) {
    const VertexId v = path[static_cast<std::size_t>(t)];
    Timestep last = t;
    while (last < end && path[static_cast<std::size_t>(last) + 1] == v) ++last;
    add(v, t, last == end && !task.leaves ? kForever : last);
    // Where agents keep apart in time they cannot pass each other on an edge either.
    if (last < end && k == 0)
      active_.push_back(
          table_.add_edge(other, sat::Lit(), v, path[static_cast<std::size_t>(last) + 1], last));
    t = last + 1;
  }
}

bool RuledPlans::give_path(AgentId agent) {
  const AgentDistances& own = distances_[agent];
  table_ = {};
  active_.clear();
  for (const AgentId j : instance_.agent_ids())
    if (j != agent) avoid(j);
  loaded_ += static_cast<std::int64_t>(active_.size());
  map_.load(table_, active_, own);
  return find_path(agent);
}

bool RuledPlans::find_path(AgentId agent) {
  const AgentDistances& own = distances_[agent];
  return own.length() != kUnreachable &&
         search_.find(own, map_, horizon_of(own), {}, paths_[agent]);
}

// What others do is loaded once. Those without a path are in nobody's way after the first timestep
// unless they are released later.
bool RuledPlans::give_paths(const std::vector<AgentId>& agents) {
  const bool is_released = std::all_of(agents.begin(), agents.end(), [&](AgentId i) {
    return instance_.agents()[i].release <= 0 && instance_.rules().robust == 0;
  });
  if (!is_released)
    return std::all_of(agents.begin(), agents.end(), [&](AgentId i) { return give_path(i); });
  table_ = {};
  active_.clear();
  for (const AgentId j : instance_.agent_ids())
    if (!paths_[j].empty()) avoid(j);
  loaded_ += static_cast<std::int64_t>(active_.size());
  map_.load(table_, active_, distances_[agents.front()]);
  for (std::size_t k = 0; k < agents.size(); ++k) {
    if (k > 0) {
      const std::size_t first = active_.size();
      avoid(agents[k - 1]);
      map_.extend(table_, std::span(active_).subspan(first), distances_[agents[k]]);
    }
    if (!find_path(agents[k])) return false;
  }
  return true;
}

bool RuledPlans::find(std::int64_t steps) {
  const std::int64_t end = effort() + steps;
  do {
    ++num_attempts_;
    loaded_ += 4;  // so that each one counts
    for (Path& path : paths_) path.clear();
    std::size_t at = 0;
    while (at < order_.size() && give_path(order_[at])) ++at;
    if (at == order_.size()) {
      cost_ = price();
      return true;
    }
    // Who had no way comes first; now and then somebody else does, as two may take turns for ever.
    std::rotate(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(at),
                order_.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    if (random_.below(4) == 0)
      std::swap(order_[random_.below(order_.size())], order_[random_.below(order_.size())]);
  } while (effort() < end);
  return false;
}

void RuledPlans::restart_from(const Plan& plan) {
  paths_ = plan.paths;
  cost_ = price();
}

Plan RuledPlans::plan() const { return {paths_, 0}; }

RuledPlans::Price RuledPlans::price() const {
  Price price{0, 0};
  for (const Path& path : paths_) {
    const Cost cost = arrival(path);
    price.sum += cost;
    price.cost = std::max(price.cost, cost);
  }
  if (objective_ == Objective::sum_of_costs) price.cost = price.sum;
  return price;
}

/// Somebody who is late, more likely the later it is, with others whose paths it comes upon, and
/// some at random.
std::vector<AgentId> RuledPlans::choose_neighbourhood() {
  const std::size_t size = std::min(kMostAtOnce, instance_.num_agents());
  std::vector<Cost> late;
  Cost sum = 0;
  for (const AgentId i : instance_.agent_ids()) {
    late.push_back(arrival(paths_[i]) - distances_[i].length());
    sum += late.back();
  }
  AgentId first(random_.below(instance_.num_agents()));
  if (sum > 0) {
    auto draw = static_cast<Cost>(random_.below(static_cast<std::uint64_t>(sum)));
    for (const AgentId i : instance_.agent_ids()) {
      if (draw < late[i.index()]) {
        first = i;
        break;
      }
      draw -= late[i.index()];
    }
  }
  std::vector<AgentId> others;
  IdVector<VertexId, bool> is_passed(instance_.graph().num_vertices(), false);
  for (const VertexId v : paths_[first]) is_passed[v] = true;
  for (const AgentId i : instance_.agent_ids())
    if (i != first &&
        std::any_of(paths_[i].begin(), paths_[i].end(), [&](VertexId v) { return is_passed[v]; }))
      others.push_back(i);
  random_.shuffle_front(others, std::min(others.size(), size - 1));
  std::vector<AgentId> chosen{first};
  for (std::size_t k = 0; k < others.size() && chosen.size() < size; ++k)
    chosen.push_back(others[k]);
  random_.shuffle_front(chosen, chosen.size());
  return chosen;
}

bool RuledPlans::improve(std::int64_t steps) {
  const std::int64_t end = effort() + steps;
  const Price before = *cost_;
  while (effort() < end && instance_.num_agents() > 0) {
    const std::vector<AgentId> chosen = choose_neighbourhood();
    loaded_ += static_cast<std::int64_t>(instance_.graph().num_vertices());
    std::vector<Path> old;
    for (const AgentId i : chosen) old.push_back(std::exchange(paths_[i], {}));
    if (give_paths(chosen) && price() <= *cost_) {
      cost_ = price();
      continue;
    }
    for (std::size_t k = 0; k < chosen.size(); ++k) paths_[chosen[k]] = std::move(old[k]);
  }
  return *cost_ < before;
}

}  // namespace quadrille::discrete
