// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/obstacles.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/sat/lemma.hpp"

namespace quadrille::discrete {

/// Where new literals and clauses go: to the engine between solves, or to it by way of the theory.
class FormulaWriter {
 public:
  virtual ~FormulaWriter() = default;
  [[nodiscard]] virtual sat::Lit new_lit() = 0;
  virtual void add(const sat::Lemma& lemma) = 0;
};

/// The literals of the lazy path model and what they mean. There is no literal for a place and time
/// until a conflict asks for one.
///
/// - Usage literals, one per obstacle: false forbids the agent what the obstacle says, true says
///   nothing. Variables are false by default in the solver, so a usage literal is a negated
///   variable: allowed unless a conflict says otherwise.
/// - Ordered cost literals "agent i costs more than k", negated variables too.
/// - A target obstacle has no literal of its own: that others keep away from the goal of i from t
///   on is active while "i costs more than t" is false.
///
/// In lemmas, the resource number of a usage is the index of its obstacle.
class LazyModel {
 public:
  /// Requires that all goals can be reached, and the distances of `instance`, which outlives the
  /// model.
  LazyModel(const Instance& instance, std::shared_ptr<const GoalDistances> distances);

  [[nodiscard]] const Instance& instance() const noexcept { return instance_; }
  [[nodiscard]] const AgentDistances& distances(AgentId agent) const {
    return distances_[agent.index()];
  }
  [[nodiscard]] const ObstacleTable& obstacles() const noexcept { return obstacles_; }

  /// The literal "the agent costs more than `cost`". Requires cost >= the free cost.
  [[nodiscard]] sat::Lit cost_above(AgentId agent, Timestep cost, FormulaWriter& writer);
  struct CostLiteral {
    Timestep cost;
    sat::Lit above;
  };
  /// All that were made, by increasing cost.
  [[nodiscard]] const std::vector<CostLiteral>& cost_literals(AgentId agent) const {
    return costs_[agent];
  }

  // The obstacle of a usage, made at the first call. Different agents' points (edges) of the same
  // place and time exclude each other by clauses that come with them.
  [[nodiscard]] ObstacleId point(AgentId agent, Visit visit, FormulaWriter& writer);
  [[nodiscard]] ObstacleId edge(AgentId agent, VertexId u, VertexId v, Timestep t,
                                FormulaWriter& writer);
  [[nodiscard]] ObstacleId range(AgentId agent, VertexId v, Timestep first, Timestep last,
                                 FormulaWriter& writer);
  /// All that the agent can do of a sweep along one line of a grid: its first and last visit tell
  /// the others.
  [[nodiscard]] ObstacleId barrier(AgentId agent, std::span<const Visit> visits,
                                   FormulaWriter& writer);
  /// Keeps `agent` away from the goal of `resident` from `t` on while that costs at most `t`.
  ObstacleId keep_off_goal(AgentId agent, AgentId resident, Timestep t, FormulaWriter& writer);

  /// The literal "the agent is in that vertex at that timestep", or at rest there if it is its
  /// goal: of an explicit path. Made anew at each call.
  [[nodiscard]] sat::Lit new_vertex(AgentId agent, Visit visit, FormulaWriter& writer);

  enum class VariableKind { auxiliary, usage, cost, vertex };
  struct Variable {
    VariableKind kind = VariableKind::auxiliary;
    AgentId agent;
    ObstacleId obstacle;  // usage
    Timestep cost = 0;    // cost: false says "costs more than this", true the opposite
    Visit visit;          // vertex
  };
  /// auxiliary for variables that are not of this model.
  [[nodiscard]] Variable variable(sat::Lit lit) const;

 private:
  using Users = std::vector<ObstacleId>;
  sat::Lit make_usage(AgentId agent, FormulaWriter& writer);
  [[nodiscard]] std::optional<ObstacleId> find_user(const Users& users, AgentId agent) const;
  /// Adds to the users of a place and time, of whom only one may be there.
  void join(Users& users, ObstacleId newcomer, FormulaWriter& writer);
  void remember(sat::Lit lit, const Variable& variable);

  const Instance& instance_;
  std::shared_ptr<const GoalDistances> goal_distances_;
  std::vector<AgentDistances> distances_;
  ObstacleTable obstacles_;
  IdVector<AgentId, std::vector<CostLiteral>> costs_;
  std::unordered_map<std::uint64_t, Users> points_;
  std::map<std::tuple<VertexId, VertexId, Timestep>, Users> edges_;
  std::map<std::tuple<AgentId, VertexId, Timestep, Timestep>, ObstacleId> ranges_;
  std::map<std::tuple<AgentId, Visit, Visit>, ObstacleId> barriers_;
  std::map<std::tuple<AgentId, AgentId, Timestep>, ObstacleId> targets_;
  std::vector<Variable> variables_;  // by variable
};

}  // namespace quadrille::discrete
