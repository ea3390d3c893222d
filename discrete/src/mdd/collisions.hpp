// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "mdd/mdd_model.hpp"
#include "quadrille/sat/lemma.hpp"

namespace quadrille::discrete {

/// Where two paths collide.
struct PathCollision {
  enum class Kind { vertex, swap };
  Kind kind;
  AgentId first, second;  // first < second
  VertexId vertex;        // of `first` at `timestep`
  VertexId to;            // swap: of `first` at timestep + 1
  Timestep timestep;
  friend bool operator==(const PathCollision&, const PathCollision&) = default;
};

/// All collisions of the plan, rests at the last vertices included, by timestep and agents. An
/// empty path collides with nothing. Each vertex and timestep is reported once per agent beyond the
/// first one there. O(agents * makespan) expected time.
[[nodiscard]] std::vector<PathCollision> find_collisions(const Graph& graph, const Plan& plan);

/// Writes the clauses that forbid collisions of usages, with their justification, to a sink.
class CollisionClauses {
 public:
  using Sink = std::function<void(const sat::Lemma&)>;
  explicit CollisionClauses(const MddModel& model) : model_(model) {}

  /// Not both X(i,v,t) and X(j,v,t). Requires two such literals of different agents.
  void vertex(sat::Lit x, sat::Lit y, const Sink& sink);
  /// Agent i does not use (u,v) at t while j uses (v,u). Requires x = X(i,u,t), x_next =
  /// X(i,v,t+1), y = X(j,v,t), y_next = X(j,u,t+1).
  void swap(sat::Lit x, sat::Lit x_next, sat::Lit y, sat::Lit y_next, const Sink& sink);
  /// X(j,g_i,t) -> i arrives after t. Requires x = X(j,g_i,t) and late = model.arrival_after(i, t).
  void rest(sat::Lit x, AgentId resident, sat::Lit late, const Sink& sink);

  /// The clauses that exclude a collision of extracted paths. `is_true` tells the assignment that
  /// the paths come from; every clause written is false under it.
  template <class IsTrue>
  void exclude(const PathCollision& c, const IsTrue& is_true, const Sink& sink) {
    const auto x = model_.at(c.first, c.vertex, c.timestep);
    if (c.kind == PathCollision::Kind::swap) {
      swap(x, model_.at(c.first, c.to, c.timestep + 1), model_.at(c.second, c.to, c.timestep),
           model_.at(c.second, c.vertex, c.timestep + 1), sink);
      return;
    }
    const auto y = model_.at(c.second, c.vertex, c.timestep);
    const auto try_rest = [&](AgentId resident, sat::Lit other) {
      if (model_.resident(c.vertex) != resident || !other.valid()) return false;
      const sat::Lit late = model_.arrival_after(resident, c.timestep);
      if (!late.valid() || is_true(late)) return false;
      rest(other, resident, late, sink);
      return true;
    };
    if (try_rest(c.first, y) || try_rest(c.second, x)) return;
    QUADRILLE_REQUIRE(x.valid() && y.valid(), "who is not at rest has a variable");
    vertex(x, y, sink);
  }

 private:
  const MddModel& model_;
};

}  // namespace quadrille::discrete
