// SPDX-License-Identifier: MIT
#include "continuous/joint/tick_search.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "continuous/support/meeting.hpp"

namespace quadrille::continuous::test {
namespace {

/// One agent between two ticks.
struct Position {
  bool is_moving = false, is_done = false;
  std::size_t place = 0;  // an edge or a vertex
  Ticks age = 0;          // of a move
  friend auto operator<=>(const Position&, const Position&) = default;
};
using State = std::vector<Position>;

class Search {
 public:
  Search(const Instance& instance, Objective objective, std::size_t max_states)
      : instance_(instance), meetings_(instance), objective_(objective), max_states_(max_states) {}

  TickSearch run() {
    State start;
    for (const Agent& a : instance_.agents()) start.push_back({false, false, a.start.index(), 0});
    reach(start, 0);
    while (!open_.empty()) {
      const auto top = open_.begin();
      const Cost cost = top->first;
      const std::vector<State> states = std::move(top->second);
      open_.erase(top);
      for (const State& state : states) {
        if (best_.at(state) < cost) continue;
        if (std::all_of(state.begin(), state.end(), [](const Position& p) { return p.is_done; }))
          return {true, cost, best_.size()};
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

  /// What agent k and those after it do in the next tick. To be done costs nothing.
  void decide(const State& state, std::size_t k) {
    if (k == state.size()) return pass_tick(state);
    decide(state, k + 1);
    const Position& p = state[k];
    if (p.is_moving || p.is_done) return;
    State next = state;
    const AgentId i(k);
    if (p.place == instance_.agent(i).goal.index()) {
      next[k].is_done = true;
      decide(next, k + 1);
    }
    for (const EdgeId e : instance_.roadmap().out_edges(VertexId(p.place))) {
      if (!is_open(instance_, i, e)) continue;
      next[k] = {true, false, e.index(), 0};
      decide(next, k + 1);
    }
  }

  void pass_tick(const State& state) {
    if (std::all_of(state.begin(), state.end(), [](const Position& p) { return p.is_done; }))
      return reach(state, cost_);
    for (std::size_t i = 0; i < state.size(); ++i)
      for (std::size_t j = 0; j < state.size(); ++j)
        if (i != j && collide(state, i, j)) return;
    State next = state;
    Cost busy = 0;
    for (std::size_t k = 0; k < state.size(); ++k) {
      if (!state[k].is_done) ++busy;
      if (!state[k].is_moving) continue;
      const EdgeId e(state[k].place);
      if (++next[k].age == instance_.duration(instance_.class_of(AgentId(k)), e))
        next[k] = {false, false, instance_.roadmap().edge(e).to.index(), 0};
    }
    reach(next, cost_ + (objective_ == Objective::makespan ? 1 : busy));
  }

  /// Whether the move of agent i collides in the coming tick, with a stay, or ever, with another
  /// move that begins now.
  bool collide(const State& state, std::size_t i, std::size_t j) {
    const Position &a = state[i], &b = state[j];
    if (!a.is_moving) return false;
    const ClassId ci = instance_.class_of(AgentId(i)), cj = instance_.class_of(AgentId(j));
    if (b.is_moving) {
      if (b.age != 0) return false;
      const auto run = meetings_.moves(ci, EdgeId(a.place), cj, EdgeId(b.place));
      return run && run->first <= a.age && a.age <= run->last;
    }
    const auto clear = meetings_.stay(ci, EdgeId(a.place), cj, VertexId(b.place));
    return clear && -(a.age + 1) < clear->after_leaving && a.age < clear->before_arrival;
  }

  const Instance& instance_;
  Meetings meetings_;
  const Objective objective_;
  const std::size_t max_states_;
  Cost cost_ = 0;
  std::map<State, Cost> best_;
  std::map<Cost, std::vector<State>> open_;
};

}  // namespace

TickSearch search_ticks(const Instance& instance, Objective objective, std::size_t max_states) {
  return Search(instance, objective, max_states).run();
}

}  // namespace quadrille::continuous::test
