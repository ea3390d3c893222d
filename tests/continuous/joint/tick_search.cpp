// SPDX-License-Identifier: MIT
#include "continuous/joint/tick_search.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "continuous/support/meeting.hpp"
#include "continuous/support/whole_places.hpp"

namespace quadrille::continuous::test {
namespace {

/// One agent between two ticks.
struct Position {
  bool is_moving = false, is_done = false;
  std::size_t place = 0;  // an edge or a vertex
  Ticks age = 0;          // of a move
  bool has_left = false;  // its start and its first move; of agents that overlap there only
  friend auto operator<=>(const Position&, const Position&) = default;
};
/// At `now`, or later if that is after all that the clock knows.
struct State {
  Ticks now = 0;
  std::vector<Position> agents;
  friend auto operator<=>(const State&, const State&) = default;
};

/// What the obstacle does, one thing after the other. `end`: later than all else.
std::vector<Element> steps_of(const MovingObstacle& obstacle, Ticks end) {
  std::vector<Element> steps;
  for (std::size_t k = 0; k < obstacle.path.size(); ++k) {
    const MovingObstacle::Stop& stop = obstacle.path[k];
    const bool is_last = k + 1 == obstacle.path.size();
    const Ticks until = is_last && !obstacle.leaves ? end : stop.depart;
    if (until > stop.arrive) steps.push_back({stop.at, stop.at, stop.arrive, until});
    if (is_last) continue;
    const MovingObstacle::Stop& next = obstacle.path[k + 1];
    steps.push_back({stop.at, next.at, stop.depart, next.arrive});
  }
  return steps;
}

class Search {
 public:
  Search(const Instance& instance, Objective objective, std::size_t max_states)
      : instance_(instance), meetings_(instance_), objective_(objective), max_states_(max_states) {
    for (const Agent& a : instance.agents())
      last_ = std::max({last_, a.release, a.deadline ? *a.deadline + 1 : Ticks{0},
                        a.under_way ? Ticks{1} : Ticks{0}});
    for (const MovingObstacle& obstacle : instance.obstacles())
      last_ = std::max(last_, obstacle.path.back().depart);
  }

  TickSearch run() {
    State start;
    for (const Agent& a : instance_.agents())
      start.agents.push_back({false, false, a.start.index(), 0});
    reach(start, 0);
    while (!open_.empty()) {
      const auto top = open_.begin();
      const Cost cost = top->first;
      const std::vector<State> states = std::move(top->second);
      open_.erase(top);
      for (const State& state : states) {
        if (best_.at(state) < cost) continue;
        if (are_done(state)) return {true, cost, best_.size()};
        if (best_.size() > max_states_) return {false, std::nullopt, best_.size()};
        cost_ = cost;
        decide(state, 0);
      }
    }
    return {true, std::nullopt, best_.size()};
  }

 private:
  void reach(const State& state, Cost cost) {
    const auto [at, is_new] = best_.try_emplace(state, cost);
    if (!is_new && at->second <= cost) return;
    at->second = cost;
    open_[cost].push_back(state);
  }

  [[nodiscard]] static bool are_done(const State& state) {
    return std::all_of(state.agents.begin(), state.agents.end(),
                       [](const Position& p) { return p.is_done; });
  }

  /// Whether the agent comes upon an obstacle while both last.
  [[nodiscard]] bool hits(AgentId i, const Element& element, ShapeId shape) const {
    for (const MovingObstacle& obstacle : instance_.obstacles())
      for (const Element& step : steps_of(obstacle, kEnd))
        if (step.begin < element.end && element.begin < step.end &&
            meet(element, instance_.agent(i).body_as(shape), step, obstacle.body))
          return true;
    return false;
  }
  [[nodiscard]] Element stay(std::size_t vertex, Ticks begin, Ticks end) const {
    const Point at = instance_.roadmap().position(VertexId(vertex));
    return {at, at, begin, end};
  }

  /// What agent k and those after it do in the next tick. To be done costs nothing.
  void decide(const State& state, std::size_t k) {
    if (k == state.agents.size()) return pass_tick(state);
    const Position& p = state.agents[k];
    if (p.is_moving || p.is_done) return decide(state, k + 1);
    State next = state;
    const AgentId i(k);
    const Agent& agent = instance_.agent(i);
    const ShapeId here = instance_.roadmap().shape(VertexId(p.place));
    const bool is_at_goal = agent.goals.contains(VertexId(p.place));
    if (is_at_goal && (!agent.deadline || state.now <= *agent.deadline) &&
        (agent.leaves || !hits(i, stay(p.place, state.now, kEnd), here))) {
      next.agents[k].is_done = true;
      decide(next, k + 1);
    }
    if (is_at_goal && agent.leaves) return;
    const bool has_to_go = (agent.under_way && p.place == agent.start.index()) ||
                           !instance_.roadmap().may_wait(VertexId(p.place));
    if (!has_to_go && !hits(i, stay(p.place, state.now, state.now + 1), here)) decide(state, k + 1);
    if (state.now < agent.release) return;
    for (const EdgeId e : instance_.roadmap().out_edges(VertexId(p.place))) {
      if (!is_open(instance_, i, e)) continue;
      const Edge& edge = instance_.roadmap().edge(e);
      if (hits(i,
               {instance_.roadmap().position(edge.from), instance_.roadmap().position(edge.to),
                state.now, state.now + instance_.duration(instance_.class_of(i), e)},
               edge.shape))
        continue;
      next.agents[k] = {true, false, e.index(), 0, p.has_left};
      decide(next, k + 1);
    }
  }

  void pass_tick(const State& state) {
    if (are_done(state)) return reach(state, cost_);
    for (std::size_t i = 0; i < state.agents.size(); ++i)
      for (std::size_t j = 0; j < state.agents.size(); ++j)
        if (i != j && collide(state.agents[i], AgentId(i), state.agents[j], AgentId(j))) return;
    State next = state;
    next.now = std::min(state.now + 1, last_);
    Cost busy = 0;
    for (std::size_t k = 0; k < state.agents.size(); ++k) {
      Position& p = next.agents[k];
      if (!p.is_done) ++busy;
      if (!p.is_moving) continue;
      const EdgeId e(p.place);
      if (++p.age == instance_.duration(instance_.class_of(AgentId(k)), e))
        p = {false, false, instance_.roadmap().edge(e).to.index(), 0,
             instance_.agent(AgentId(k)).overlaps_at_start};
    }
    reach(next, cost_ + (objective_ == Objective::makespan ? 1 : busy));
  }

  /// Whether the move of agent i collides in the coming tick, with a stay, or ever, with another
  /// move that begins now.
  bool collide(const Position& a, AgentId i, const Position& b, AgentId j) {
    if (b.is_done && instance_.agent(j).leaves) return false;
    if (are_parked(a, i, b, j)) return false;
    if (!a.is_moving) return do_overlap_later(a, i, b, j);
    const ClassId ci = instance_.class_of(i), cj = instance_.class_of(j);
    if (b.is_moving) {
      if (b.age != 0) return false;
      const auto run = meetings_.moves(ci, EdgeId(a.place), cj, EdgeId(b.place));
      return run && run->first <= a.age && a.age <= run->last;
    }
    const auto clear = meetings_.stay(ci, EdgeId(a.place), cj, VertexId(b.place));
    return clear && -(a.age + 1) < clear->after_leaving && a.age < clear->before_arrival;
  }

  /// They overlap at their starts, where one of them is, and the other one is or comes from, to a
  /// place where they are apart.
  bool are_parked(const Position& a, AgentId i, const Position& b, AgentId j) const {
    const Agent &x = instance_.agent(i), &y = instance_.agent(j);
    if (!x.overlaps_at_start || !y.overlaps_at_start || a.has_left || b.has_left) return false;
    const auto overlap = [&](std::size_t v, std::size_t w) {
      return meet(stay(v, 0, 1), x.body, stay(w, 0, 1), y.body);
    };
    const auto end = [&](const Position& p) {
      return p.is_moving ? instance_.roadmap().edge(EdgeId(p.place)).to.index() : p.place;
    };
    if ((a.is_moving && b.is_moving) || !overlap(x.start.index(), y.start.index())) return false;
    return a.is_moving == b.is_moving || !overlap(end(a), end(b));
  }
  /// Two that stand where they did not overlap from the beginning: only who may park there comes
  /// there without a collision on the way.
  bool do_overlap_later(const Position& a, AgentId i, const Position& b, AgentId j) const {
    const Agent &x = instance_.agent(i), &y = instance_.agent(j);
    if (b.is_moving || (a.is_done && x.leaves) || !x.overlaps_at_start || !y.overlaps_at_start)
      return false;
    return meet(stay(a.place, 0, 1), x.body, stay(b.place, 0, 1), y.body);
  }

  static constexpr Ticks kEnd = 1'000'000'000;  // later than all else

  const Instance instance_;
  Meetings meetings_;
  const Objective objective_;
  const std::size_t max_states_;
  Ticks last_ = 0;  // from then on the clock changes nothing
  Cost cost_ = 0;
  std::map<State, Cost> best_;
  std::map<Cost, std::vector<State>> open_;
};

}  // namespace

TickSearch search_ticks(const Instance& instance, Objective objective, std::size_t max_states) {
  return Search(with_whole_places(instance), objective, max_states).run();
}

}  // namespace quadrille::continuous::test
