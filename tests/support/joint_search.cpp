// SPDX-License-Identifier: MIT
#include "support/joint_search.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "support/ruled_search.hpp"

namespace quadrille::discrete::support {
namespace {

using Place = std::uint32_t;    // a vertex
using StateId = std::uint32_t;  // positions and committed set as one number

constexpr Cost kInfinite = std::numeric_limits<Cost>::max();
constexpr StateId kNoState = std::numeric_limits<StateId>::max();

struct State {
  std::vector<Place> at;
  std::uint32_t committed = 0;  // bit i: agent i stays where it is for ever, at a goal

  [[nodiscard]] bool is_committed(std::size_t agent) const { return (committed >> agent & 1) != 0; }
};

/// Best-first search with a consistent heuristic; buckets by estimated total cost.
class JointSearch {
 public:
  JointSearch(const Instance& instance, Objective objective)
      : sum_(objective == Objective::sum_of_costs), agents_(instance.num_agents()) {
    const Graph& graph = instance.graph();
    moves_.resize(graph.num_vertices());
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      for (const VertexId w : graph.neighbours(v)) moves_[v.index()].push_back(w.value());
      moves_[v.index()].push_back(v.value());
    }
    for (const Agent& task : instance.agents()) {
      start_.at.push_back(task.start.value());
      goals_.emplace_back(moves_.size());
      for (const VertexId goal : task.goals.vertices()) goals_.back()[goal.index()] = true;
      far_.push_back(distances_to(task.goals));
    }
  }

  /// Number of states, or a larger number than `limit`.
  [[nodiscard]] std::size_t count_states(std::size_t limit) const {
    std::size_t count = 1;
    for (std::size_t i = 0; i < agents_ && count <= limit; ++i)
      count *= moves_.size() * (sum_ ? 2 : 1);
    return count;
  }

  [[nodiscard]] JointAnswer run(std::size_t num_states) {
    best_.assign(num_states, kInfinite);
    parent_.assign(num_states, kNoState);
    std::vector<bool> closed(num_states);
    reach(start_, 0, kNoState);
    for (std::size_t f = 0; f < buckets_.size(); ++f) {
      while (!buckets_[f].empty()) {
        const StateId id = buckets_[f].back();
        buckets_[f].pop_back();
        if (closed[id]) continue;
        closed[id] = true;
        const State state = decode(id);
        if (is_final(state)) return {Status::optimal, best_[id], plan_to(id)};
        expand(state, id);
      }
    }
    return {Status::infeasible, 0, {}};
  }

 private:
  /// To the nearest.
  [[nodiscard]] std::vector<Cost> distances_to(const Goals& goals) const {
    std::vector<Cost> distance(moves_.size(), kInfinite);
    std::vector<Place> queue;
    for (const VertexId goal : goals.vertices()) {
      queue.push_back(goal.value());
      distance[goal.index()] = 0;
    }
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (const Place next : moves_[queue[head]])
        if (distance[next] == kInfinite) {
          distance[next] = distance[queue[head]] + 1;
          queue.push_back(next);
        }
    return distance;
  }

  [[nodiscard]] StateId encode(const State& state) const {
    std::size_t code = 0;
    for (const Place place : state.at) code = code * moves_.size() + place;
    if (sum_) code = code << agents_ | state.committed;
    return static_cast<StateId>(code);
  }
  [[nodiscard]] State decode(StateId id) const {
    State state;
    std::size_t code = id;
    if (sum_) {
      state.committed = id & ((1U << agents_) - 1U);
      code >>= agents_;
    }
    state.at.resize(agents_);
    for (std::size_t i = agents_; i-- > 0; code /= moves_.size())
      state.at[i] = static_cast<Place>(code % moves_.size());
    return state;
  }

  [[nodiscard]] bool is_at_goal(const State& state, std::size_t agent) const {
    return goals_[agent][state.at[agent]];
  }
  [[nodiscard]] bool is_final(const State& state) const {
    if (sum_) return state.committed == (1U << agents_) - 1U;
    for (std::size_t i = 0; i < agents_; ++i)
      if (!is_at_goal(state, i)) return false;
    return true;
  }

  /// A lower bound on the cost from here; kInfinite if some goal is out of reach.
  [[nodiscard]] Cost estimate(const State& state) const {
    Cost total = 0;
    for (std::size_t i = 0; i < agents_; ++i) {
      const Cost distance = far_[i][state.at[i]];
      if (distance == kInfinite) return kInfinite;
      total = sum_ ? total + distance : std::max(total, distance);
    }
    return total;
  }

  void reach(const State& state, Cost cost, StateId from) {
    const Cost rest = estimate(state);
    const StateId id = encode(state);
    if (rest == kInfinite || cost >= best_[id]) return;
    best_[id] = cost;
    parent_[id] = from;
    const auto bucket = static_cast<std::size_t>(cost + rest);
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(id);
  }

  void expand(const State& state, StateId id) {
    Cost price = 1;
    if (sum_) {
      price = 0;
      for (std::size_t i = 0; i < agents_; ++i) {
        if (state.is_committed(i)) continue;
        ++price;
        if (!is_at_goal(state, i)) continue;
        State commits = state;
        commits.committed |= 1U << i;
        reach(commits, best_[id], id);
      }
    }
    State next = state;
    move(state, next, 0, best_[id] + price, id);
  }

  /// All joint moves that extend the moves of agents 0 .. agent-1 in `next`.
  void move(const State& state, State& next, std::size_t agent, Cost cost, StateId id) {
    if (agent == agents_) return reach(next, cost, id);
    const std::vector<Place> stay{state.at[agent]};
    for (const Place to : state.is_committed(agent) ? stay : moves_[state.at[agent]]) {
      bool free = true;
      for (std::size_t j = 0; j < agent && free; ++j)
        free = next.at[j] != to && !(next.at[j] == state.at[agent] && state.at[j] == to);
      if (!free) continue;
      next.at[agent] = to;
      move(state, next, agent + 1, cost, id);
    }
  }

  [[nodiscard]] Plan plan_to(StateId id) const {
    std::vector<State> states{decode(id)};
    // Committing takes no time; every timestep costs something.
    for (StateId at = id; parent_[at] != kNoState; at = parent_[at])
      if (best_[parent_[at]] != best_[at]) states.push_back(decode(parent_[at]));
    std::reverse(states.begin(), states.end());
    Plan plan;
    plan.paths.resize(agents_);
    for (const State& state : states)
      for (std::size_t i = 0; i < agents_; ++i)
        plan.paths[AgentId(i)].push_back(VertexId(state.at[i]));
    trim(plan);
    return plan;
  }

  bool sum_;
  std::size_t agents_;
  std::vector<std::vector<Place>> moves_;  // neighbours and the vertex itself
  std::vector<std::vector<bool>> goals_;   // per agent, by vertex
  std::vector<std::vector<Cost>> far_;     // per agent: distance to its nearest goal
  State start_;
  std::vector<Cost> best_;
  std::vector<StateId> parent_;
  std::vector<std::vector<StateId>> buckets_;
};

std::string at_step(std::size_t agent, std::size_t t) {
  return "agent " + std::to_string(agent) + " at timestep " + std::to_string(t);
}

/// What is wrong between timesteps t-1 and t; `at` gives places, held after a path's end.
template <class At>
std::string replay_step(const Instance& instance, const At& at, std::size_t t) {
  for (std::size_t i = 0; i < instance.num_agents(); ++i) {
    const bool moved = t > 0 && at(i, t - 1) != at(i, t);
    if (moved) {
      const auto near = instance.graph().neighbours(at(i, t - 1));
      if (std::find(near.begin(), near.end(), at(i, t)) == near.end())
        return at_step(i, t) + ": no such move";
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (at(i, t) == at(j, t)) return at_step(i, t) + ": in the place of " + std::to_string(j);
      if (moved && at(i, t) == at(j, t - 1) && at(i, t - 1) == at(j, t))
        return at_step(i, t) + ": swaps with " + std::to_string(j);
    }
  }
  return "";
}

}  // namespace

JointAnswer joint_search(const Instance& instance, Objective objective, std::size_t max_states) {
  max_states = std::min<std::size_t>(max_states, kNoState);
  if (!instance.is_plain()) return ruled_search(instance, objective, max_states);
  JointSearch search(instance, objective);
  const std::size_t num_states = search.count_states(max_states);
  if (num_states > max_states) return {};
  return search.run(num_states);
}

std::string replay(const Instance& instance, const Plan& plan) {
  if (!instance.is_plain()) return replay_rules(instance, plan);
  if (plan.paths.size() != instance.num_agents()) return "not one path per agent";
  std::size_t length = 1;
  for (const AgentId i : instance.agent_ids()) {
    const Path& path = plan.paths[i];
    if (path.empty()) return "an empty path";
    if (path.front() != instance.agents()[i].start) return at_step(i.index(), 0) + ": wrong start";
    if (!instance.agents()[i].goals.contains(path.back()))
      return at_step(i.index(), 0) + ": wrong goal";
    for (const VertexId v : path)
      if (v.index() >= instance.graph().num_vertices()) return "no such vertex";
    length = std::max(length, path.size());
  }
  const auto at = [&plan](std::size_t i, std::size_t t) {
    const Path& path = plan.paths[AgentId(i)];
    return t < path.size() ? path[t] : path.back();
  };
  for (std::size_t t = 0; t < length; ++t)
    if (std::string problem = replay_step(instance, at, t); !problem.empty()) return problem;
  return "";
}

}  // namespace quadrille::discrete::support
