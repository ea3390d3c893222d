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
  Timestep gap = 0;  // vertex: `second` is there that much later, or before
  friend bool operator==(const PathCollision&, const PathCollision&) = default;
};

/// All collisions of the plan, rests at the last vertices included, by timestep and agents. An
/// empty path collides with nothing. Each vertex and timestep is reported once per agent beyond the
/// first one there; agents that are too near to each other in time, only with the last one before.
/// O(agents * makespan) expected time.
[[nodiscard]] std::vector<PathCollision> find_collisions(const Instance& instance,
                                                         const Plan& plan);

/// Writes the clauses that forbid collisions of usages, with their justification, to a sink.
class CollisionClauses {
 public:
  using Sink = std::function<void(const sat::Lemma&)>;
  explicit CollisionClauses(const MddModel& model) : model_(model) {}

  // Each clause has MddModel::gone of its X literals, where there is one.

  /// Not both X(i,v,t) and X(j,v,t). Requires two such literals of different agents; or of
  /// timesteps that are too near to each other.
  void vertex(sat::Lit x, sat::Lit y, const Sink& sink);
  /// Agent i does not use (u,v) at t while j uses (v,u). Requires x = X(i,u,t), x_next =
  /// X(i,v,t+1), y = X(j,v,t), y_next = X(j,u,t+1).
  void swap(sat::Lit x, sat::Lit x_next, sat::Lit y, sat::Lit y_next, const Sink& sink);
  /// X(j,g,t) -> i does not end at g, or arrives after t, and as long after as rules ask for.
  /// Requires x = X(j,g,t), a goal g of i, and late = late_for(i, t).
  void rest(sat::Lit x, AgentId resident, sat::Lit late, const Sink& sink);

  /// Not both end at `goal`, which both have among theirs.
  void end(AgentId first, AgentId second, VertexId goal, const Sink& sink);

  /// "The resident arrives so late that somebody may be at its goal at `t`", see arrival_after.
  [[nodiscard]] sat::Lit late_for(AgentId resident, Timestep t) const {
    return model_.arrival_after(resident, t + model_.robust());
  }

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
    const auto y = model_.at(c.second, c.vertex, c.timestep + c.gap);
    // Whether clauses can say that the agent is at rest there.
    const auto is_at_rest = [&](AgentId agent, Timestep t) {
      if (!model_.may_stay(agent, c.vertex)) return false;
      const sat::Lit ends = model_.end_at(agent, c.vertex), late = late_for(agent, t);
      return (!ends.valid() || is_true(ends)) && late.valid() && !is_true(late);
    };
    const auto try_rest = [&](AgentId resident, sat::Lit other, Timestep t) {
      if (!other.valid() || !is_at_rest(resident, t)) return false;
      rest(other, resident, late_for(resident, t), sink);
      return true;
    };
    // Who is there without a variable is at rest there, later than any clause needs to know.
    const bool at_last = !x.valid() && !y.valid();
    if (at_last || (is_at_rest(c.first, c.timestep) && is_at_rest(c.second, c.timestep + c.gap))) {
      end(c.first, c.second, c.vertex, sink);
      return;
    }
    if (try_rest(c.first, y, c.timestep + c.gap) || try_rest(c.second, x, c.timestep)) return;
    QUADRILLE_REQUIRE(x.valid() && y.valid(), "who is not at rest has a variable");
    vertex(x, y, sink);
  }

 private:
  const MddModel& model_;
};

}  // namespace quadrille::discrete
