// SPDX-License-Identifier: MIT
#include "ruled/turning_order.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "quadrille/core/heading.hpp"

namespace quadrille::discrete {
namespace {

/// A move of the plan that is to begin later.
struct Move {
  AgentId agent;
  VertexId from, to;
  Timestep begin = 0;
  std::optional<std::size_t> before;  // of the same timestep: who leaves `to` to make room
};

class Order {
 public:
  Order(const Instance& instance, const Plan& plan)
      : instance_(instance),
        plan_(plan),
        ready_(instance.num_agents(), 0),
        left_(instance.graph().num_vertices(), 0),
        mover_from_(instance.graph().num_vertices()) {
    for (const AgentId i : instance.agent_ids()) {
      heading_.push_back(instance.agents()[i].heading);
      later_.paths.push_back({instance.agents()[i].start});
    }
  }

  Plan run() {
    std::size_t length = 0;
    for (const Path& path : plan_.paths) length = std::max(length, path.size());
    for (std::size_t t = 0; t + 1 < length; ++t) step(t);
    trim(later_);
    return std::move(later_);
  }

 private:
  /// All moves that begin at `t` in the plan.
  void step(std::size_t t) {
    moves_.clear();
    for (const AgentId i : instance_.agent_ids()) {
      const Path& path = plan_.paths[i];
      if (t + 1 >= path.size() || path[t] == path[t + 1]) continue;
      mover_from_[path[t]] = moves_.size();
      moves_.push_back({i, path[t], path[t + 1], ready_to_go(i, path[t], path[t + 1]), {}});
    }
    for (Move& move : moves_) {
      move.before = mover_from_[move.to];
      move.begin = std::max(move.begin, left_[move.to]);
    }
    // Who comes to a place begins no sooner than who leaves it. Round a circle all begin at once.
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (Move& move : moves_) {
        if (!move.before || moves_[*move.before].begin <= move.begin) continue;
        move.begin = moves_[*move.before].begin;
        is_changed = true;
      }
    }
    for (const Move& move : moves_) {
      Path& path = later_.paths[move.agent];
      path.resize(static_cast<std::size_t>(move.begin) + 1, move.from);
      path.push_back(move.to);
      ready_[move.agent] = move.begin + 1;
      left_[move.from] = move.begin;
      mover_from_[move.from].reset();
    }
  }

  /// When it has turned to where it goes, which it faces from then on.
  Timestep ready_to_go(AgentId i, VertexId from, VertexId to) {
    const GridLayout& layout = *instance_.graph().layout();
    const Cell a = layout.cell_of(from), b = layout.cell_of(to);
    const Heading ahead = heading_of_move(b.x - a.x, b.y - a.y);
    Timestep quarters = 0;
    if (heading_[i] != ahead)
      quarters = left_of(heading_[i]) == ahead || right_of(heading_[i]) == ahead ? 1 : 2;
    heading_[i] = ahead;
    return ready_[i] + quarters * instance_.rules().turn;
  }

  const Instance& instance_;
  const Plan& plan_;
  Plan later_;
  IdVector<AgentId, Heading> heading_;
  IdVector<AgentId, Timestep> ready_;  // since when it is where it is
  IdVector<VertexId, Timestep> left_;  // when its last visitor began to leave
  IdVector<VertexId, std::optional<std::size_t>> mover_from_;
  std::vector<Move> moves_;
};

}  // namespace

Plan with_turns(const Instance& instance, const Plan& plan) { return Order(instance, plan).run(); }

}  // namespace quadrille::discrete
