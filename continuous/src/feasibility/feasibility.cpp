// SPDX-License-Identifier: MIT
#include "feasibility/feasibility.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace quadrille::continuous {
namespace {

constexpr std::size_t kMaxStates = 500'000;

/// What some agents do, without the times: each stands at a vertex or moves along an edge. In the
/// order of time (at the same tick arrivals before departures, otherwise any order) the events of a
/// plan lead from state to state; a step is refused only if it collides at all times that it may
/// happen at. So goals that cannot be reached here cannot be reached.
class Configurations {
 public:
  Configurations(Model& model, std::vector<AgentId> agents)
      : model_(model),
        agents_(std::move(agents)),
        num_edges_(model.instance().roadmap().num_edges()),
        num_places_(num_edges_ + model.instance().roadmap().num_vertices()) {}

  /// Whether the goals can be reached. True as well if that takes too many states to find out.
  bool can_reach_goals(std::size_t max_states) {
    State start, goal;
    std::uint64_t codes = 1;
    for (const AgentId i : agents_) {
      const Agent& agent = model_.instance().agent(i);
      start.push_back({num_edges_ + agent.start.index(), 0});
      goal.push_back({num_edges_ + agent.goal.index(), 0});
      const std::uint64_t factor = num_places_ * (agents_.size() + 1);
      if (codes > UINT64_MAX / factor) return true;
      codes *= factor;
    }
    visit(start);
    while (!open_.empty()) {
      const State state = std::move(open_.back());
      open_.pop_back();
      if (state == goal || seen_.size() > max_states || model_.limits().exhausted()) return true;
      expand(state);
    }
    return false;
  }
  [[nodiscard]] std::size_t num_states() const { return seen_.size(); }

 private:
  struct Position {
    std::size_t place;  // an edge, or a vertex after all edges
    std::size_t rank;   // of those that move, in the order in which they began; from 1 on
    friend bool operator==(const Position&, const Position&) = default;
  };
  using State = std::vector<Position>;

  void visit(const State& state) {
    std::uint64_t code = 0;
    for (const Position& p : state)
      code = (code * num_places_ + p.place) * (agents_.size() + 1) + p.rank;
    if (seen_.insert(code).second) open_.push_back(state);
  }

  void expand(const State& state) {
    const Roadmap& roadmap = model_.instance().roadmap();
    for (std::size_t k = 0; k < state.size(); ++k) {
      const auto all_others = [&](const auto& agree) {
        for (std::size_t j = 0; j < state.size(); ++j)
          if (j != k && !agree(j)) return false;
        return true;
      };
      if (is_moving(state[k])) {
        const EdgeId e(state[k].place);
        if (!all_others([&](std::size_t j) { return can_end(state, k, e, j); })) continue;
        State next = state;
        for (Position& p : next)
          if (p.rank > state[k].rank) --p.rank;
        next[k] = {num_edges_ + roadmap.edge(e).to.index(), 0};
        visit(next);
        continue;
      }
      std::size_t num_moving = 0;
      for (const Position& p : state) num_moving += is_moving(p) ? 1 : 0;
      for (const EdgeId e : roadmap.out_edges(VertexId(state[k].place - num_edges_))) {
        if (!all_others([&](std::size_t j) { return can_begin(state, k, e, j); })) continue;
        State next = state;
        next[k] = {e.index(), num_moving + 1};
        visit(next);
      }
    }
  }

  [[nodiscard]] bool is_moving(const Position& p) const { return p.place < num_edges_; }

  /// Whether agent k can begin e in this state as far as agent j is concerned.
  bool can_begin(const State& state, std::size_t k, EdgeId e, std::size_t j) {
    if (is_moving(state[j])) {
      // j began f before and is on its way.
      const EdgeId f(state[j].place);
      return is_safe_for_some(k, e, j, f, 1 - duration(j, f), 0);
    }
    const auto w = window(k, e, j, state[j].place);
    return !w || w->first >= 0;
  }

  /// Whether agent k can arrive in this state as far as agent j is concerned.
  bool can_end(const State& state, std::size_t k, EdgeId e, std::size_t j) {
    if (is_moving(state[j])) {
      // j arrives at the same tick or later.
      const EdgeId f(state[j].place);
      const Ticks least = duration(k, e) - duration(j, f);
      return state[j].rank < state[k].rank
                 ? is_safe_for_some(k, e, j, f, std::max(1 - duration(j, f), least), 0)
                 : is_safe_for_some(k, e, j, f, std::max<Ticks>(0, least), duration(k, e) - 1);
    }
    // Who stands there at this moment must not overlap with the end of the move.
    const auto w = window(k, e, j, state[j].place);
    return !w || w->last <= duration(k, e);
  }

  /// Whether j can begin f at some offset of [least, most] from when k begins e.
  bool is_safe_for_some(std::size_t k, EdgeId e, std::size_t j, EdgeId f, Ticks least, Ticks most) {
    if (least > most) return false;
    const auto offsets = model_.contacts().offsets(class_of(k), e, class_of(j), f);
    return !offsets || least < offsets->lo || offsets->hi < most;
  }

  [[nodiscard]] Ticks duration(std::size_t k, EdgeId e) const {
    return model_.instance().duration(class_of(k), e);
  }
  [[nodiscard]] Contacts::Window window(std::size_t k, EdgeId e, std::size_t j, std::size_t place) {
    return model_.contacts().window(class_of(k), e, class_of(j), VertexId(place - num_edges_));
  }
  [[nodiscard]] ClassId class_of(std::size_t k) const {
    return model_.instance().class_of(agents_[k]);
  }

  Model& model_;
  const std::vector<AgentId> agents_;
  const std::size_t num_edges_, num_places_;
  std::unordered_set<std::uint64_t> seen_;
  std::vector<State> open_;
};

}  // namespace

std::vector<AgentId> find_blocked_agents(Model& model) {
  const std::size_t num_agents = model.instance().num_agents();
  std::size_t left = kMaxStates;
  for (std::size_t i = 0; i < num_agents; ++i)
    for (std::size_t j = i + 1; j < num_agents; ++j) {
      if (left == 0 || model.limits().exhausted_now()) return {};
      Configurations pair(model, {AgentId(i), AgentId(j)});
      if (!pair.can_reach_goals(left)) return {AgentId(i), AgentId(j)};
      left -= std::min(left, pair.num_states());
    }
  std::vector<AgentId> all;
  for (const AgentId i : model.instance().agent_ids()) all.push_back(i);
  if (num_agents > 2 && !Configurations(model, all).can_reach_goals(kMaxStates)) return all;
  return {};
}

}  // namespace quadrille::continuous
