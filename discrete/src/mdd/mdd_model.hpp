// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mdd/mdd_paths.hpp"
#include "model/blocked_times.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/sat/engine.hpp"

namespace quadrille::discrete {

/// The propositional formula over the agents' MDDs (docs/soundness/mdd.md): variables X(i,v,t)
/// "agent i is in v at t", C(i,k) "agent i arrives at d_i + k or later" and, of agents with several
/// goals, E(i,g) "agent i ends at g", and the clauses that each agent satisfies on its own. Grows;
/// every clause stays valid when it does, so learned clauses survive.
///
/// A true assignment contains a path per agent. It may have further true X(i,v,t): at most one
/// vertex per timestep is not demanded, and not needed.
class MddModel {
 public:
  enum class VariableKind : std::uint8_t {
    auxiliary,  ///< Not of this model.
    vertex,     ///< X(agent, vertex, number).
    delay,      ///< C(agent, number).
    end,        ///< E(agent, vertex).
  };
  struct Variable {
    VariableKind kind = VariableKind::auxiliary;
    AgentId agent;
    VertexId vertex;
    Timestep number = 0;  ///< Timestep or delay.
  };

  /// Whether the model can express the rules of the instance: all but waypoints and turns.
  [[nodiscard]] static bool knows(const Instance& instance);

  MddModel(const Instance& instance, Objective objective);
  /// Computes the agents' distances and sends all clauses to `engine` from now on; to be called
  /// once, before anything below. Requires that every agent can reach its goal. `lone`: what agents
  /// cost when they are alone; empty: what their ways are long. False if `limits` ended that early;
  /// the model is of no use then. O(agents * (V + E)).
  [[nodiscard]] bool attach(sat::Engine& engine, LimitMonitor& limits,
                            IdVector<AgentId, Timestep> lone = {});
  /// What the agent costs when it is alone. Delays count from Mdd::distance.
  [[nodiscard]] Timestep free_cost(AgentId agent) const {
    return lone_.empty() ? mdd(agent).distance() : lone_[agent];
  }

  /// Lets the agent's paths have a delay of up to `cap`: its variables, clauses and the guard
  /// C(i, cap + 1) whose negation restricts it to them. No effect if it is there. False if `limits`
  /// ended that early, or paths would be longer than kMaxTimestep; the model is of no further use
  /// then.
  [[nodiscard]] bool extend(AgentId agent, Timestep cap, LimitMonitor& limits);
  /// Largest delay that the agent's paths can have; -1 before the first `extend`.
  [[nodiscard]] Timestep cap(AgentId agent) const { return agents_[agent].paths.cap(); }

  /// X(agent, v, t), invalid if there is no such variable. O(1).
  [[nodiscard]] sat::Lit at(AgentId agent, VertexId v, Timestep t) const {
    return agents_[agent].paths.at(v, t);
  }
  /// E(agent, goal), invalid if it has no other goal. Requires one of its goals. O(log goals).
  [[nodiscard]] sat::Lit end_at(AgentId agent, VertexId goal) const;
  /// C(agent, delay), made if need be. Requires delay >= 1. Not during solve.
  [[nodiscard]] sat::Lit delay_at_least(AgentId agent, Timestep delay);
  /// C(agent, delay), invalid if nobody asked for it so far.
  [[nodiscard]] sat::Lit find_delay(AgentId agent, Timestep delay) const;
  /// A literal "the agent arrives after `t`" if the clauses about its rest at the goal need one: if
  /// t is not before its earliest arrival, and it can be at rest without an X(i, goal, t), or the
  /// objective charges it for arriving late. Otherwise invalid: being there is all that matters.
  [[nodiscard]] sat::Lit arrival_after(AgentId agent, Timestep t) const;

  /// What a literal's variable means.
  [[nodiscard]] Variable variable(sat::Lit lit) const;
  /// One more than the largest variable of the model; smaller ones can be auxiliary.
  [[nodiscard]] int variable_end() const { return static_cast<int>(variables_.size()); }

  [[nodiscard]] const Instance& instance() const noexcept { return instance_; }
  [[nodiscard]] Objective objective() const noexcept { return objective_; }
  [[nodiscard]] const Mdd& mdd(AgentId agent) const { return agents_[agent].paths.mdd(); }
  /// The agents that may stay at `v`, a goal of theirs, in order.
  [[nodiscard]] std::span<const AgentId> residents(VertexId v) const { return residents_[v]; }
  [[nodiscard]] bool may_stay(AgentId agent, VertexId v) const {
    const auto& task = instance_.agents()[agent];
    return !task.leaves && task.goals.contains(v);
  }
  /// Nobody is in a vertex for so many timesteps before and after somebody else.
  [[nodiscard]] Timestep robust() const noexcept { return instance_.rules().robust; }
  /// X literals of an agent that leaves stay true at its goal when it is gone: a literal that says
  /// "it arrives before then", so that X and its negation mean that it is there. Invalid where X
  /// means that by itself.
  [[nodiscard]] sat::Lit gone(sat::Lit x) const;

  /// False if the assignment lets the agent be later than its cap: then it promises no path.
  template <class IsTrue>
  [[nodiscard]] bool has_path(AgentId agent, const IsTrue& is_true) const {
    return !is_true(agents_[agent].delays.at(cap(agent) + 1));
  }
  /// The path in a complete assignment that satisfies the model's clauses. Requires `has_path`.
  /// `is_true(Lit)` tells the assignment.
  template <class IsTrue>
  [[nodiscard]] Path extract_path(AgentId agent, const IsTrue& is_true) const {
    Path path = extract_walk(agent, is_true);
    QUADRILLE_REQUIRE(
        static_cast<Timestep>(path.size()) > agents_[agent].paths.mdd().distance() + cap(agent),
        "a true vertex has a true successor");
    QUADRILLE_REQUIRE(is_end(agent, path.back(), is_true), "the guard forces a goal");
    path.resize(static_cast<std::size_t>(arrival(path)) + 1);
    return path;
  }
  /// As far as a partial assignment says where the agent goes, from timestep 0 on.
  template <class IsTrue>
  [[nodiscard]] Path extract_walk(AgentId agent, const IsTrue& is_true) const {
    const Mdd& mdd = agents_[agent].paths.mdd();
    const Timestep end = mdd.distance() + cap(agent);
    Path path{mdd.task().start};
    for (Timestep t = 1; t <= end; ++t) {
      const VertexId from = path.back();
      const auto can_be = [&](VertexId v) {
        const sat::Lit lit = at(agent, v, t);
        return lit.valid() && is_true(lit);
      };
      std::optional<VertexId> next;
      if (can_be(from) && is_end(agent, from, is_true)) next = from;
      for (const VertexId w : instance_.graph().neighbours(from))
        if (!next && can_be(w)) next = w;
      if (!next && can_be(from)) next = from;
      if (!next) break;
      path.push_back(*next);
    }
    return path;
  }

 private:
  struct Agent {
    MddPaths paths;
    std::map<Timestep, sat::Lit> delays;
    std::vector<sat::Lit> ends;  // by goal; empty if there is one only
  };
  class AgentFormula;
  /// Where several goals are called its end, it ends at the one that it comes to.
  template <class IsTrue>
  [[nodiscard]] bool is_end(AgentId agent, VertexId v, const IsTrue& is_true) const {
    if (!agents_[agent].paths.mdd().is_goal(v)) return false;
    const sat::Lit end = end_at(agent, v);
    return !end.valid() || is_true(end);
  }
  [[nodiscard]] sat::Lit new_lit(const Variable& variable);
  void prepare_rest(AgentId agent, VertexId v, Timestep t);
  /// The clauses of the agent's own rules, over literals of layers beyond `old_cap`.
  void add_rules(AgentId agent, Timestep old_cap);
  void add_bans(AgentId agent, Timestep old_cap);

  Instance instance_;
  Objective objective_;
  sat::Engine* engine_ = nullptr;
  IdVector<AgentId, Agent> agents_;
  IdVector<AgentId, Timestep> lone_;
  BlockedTimes blocked_;
  IdVector<VertexId, std::vector<AgentId>> residents_;
  std::vector<Variable> variables_;
};

}  // namespace quadrille::discrete
