// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/lazy/trail.hpp"
#include "quadrille/lazy/writer.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::lazy {

/// More than any plan costs (2^61): the cap of an agent that has none.
inline constexpr Cost kNoCap = std::numeric_limits<std::int64_t>::max() / 4;

/// The literals of a lazy path model and what they mean. There is no literal for anything that an
/// agent can do until a conflict asks for one.
///
/// - Usage literals "allowed", one per obstacle: false forbids the agent what the obstacle says,
///   true says nothing. Variables are false by default in the solver, so a usage literal is a
///   negated variable: allowed unless a conflict says otherwise.
/// - A ladder of ordered literals "the agent costs `cost` or more" for each agent.
/// - An obstacle at a goal has no usage literal of its own. Where an agent can only end there, that
///   others keep away while it costs less than `cost` is active while "it costs `cost` or more" is
///   false. Where it can end elsewhere, its cost does not say where it rests: then a literal does,
///   "it rests there, and costs less than `cost`", which follows from "it ends there" and "it costs
///   less than `cost`".
/// - Where goals have prices and may be left over, a literal "nobody ends there" for each of these.
///
/// In lemmas, the resource number of a usage is the index of its obstacle.
class Vocabulary {
 public:
  virtual ~Vocabulary() = default;
  Vocabulary(const Vocabulary&) = delete;
  Vocabulary& operator=(const Vocabulary&) = delete;

  /// What the agent costs when nothing hinders it.
  [[nodiscard]] virtual Cost free_cost(AgentId agent) const = 0;
  /// No plan makes the agent cost this or more.
  [[nodiscard]] virtual Cost cost_bound(AgentId /*agent*/) const { return kNoCap; }

  /// The literal "the agent costs `cost` or more". Requires cost > free_cost.
  [[nodiscard]] sat::Lit at_least(AgentId agent, Cost cost, FormulaWriter& writer);
  /// The same, for a search that caps the agent's cost at `cap`: at_least(agent, cap + 1).
  [[nodiscard]] sat::Lit above(AgentId agent, Cost cap, FormulaWriter& writer);
  struct Rung {
    Cost cost;
    sat::Lit at_least;
    /// A lemma speaks of it. No lemma speaks of rungs that were made for caps: so what is refuted
    /// for one of those is refuted for the next natural one.
    bool is_natural;
  };
  /// All that were made, by increasing cost.
  [[nodiscard]] const std::vector<Rung>& rungs(AgentId agent) const { return ladders_[agent]; }

  enum class VariableKind : std::uint8_t {
    auxiliary,  ///< Not of this vocabulary.
    usage,
    cost,
    rest,  ///< The positive literal says that the agent rests at `goal` and costs less than `cost`.
    left_over,  ///< The positive literal says that nobody ends at `goal`. Of no agent.
    own         ///< Of the domain: it knows what.
  };
  struct Variable {
    VariableKind kind = VariableKind::auxiliary;
    AgentId agent;
    Cost cost = 0;        // cost: see is_at_least; rest
    ObstacleId obstacle;  // usage: true says that it is forbidden
    std::uint32_t own = 0;
    VertexId goal;  // rest, left_over
  };
  [[nodiscard]] Variable variable(sat::Lit lit) const {
    const auto index = static_cast<std::size_t>(lit.variable());
    return index < variables_.size() ? variables_[index] : Variable{};
  }
  /// Of a literal of kind cost: whether it says "this cost or more", or the opposite.
  [[nodiscard]] bool is_at_least(sat::Lit lit) const noexcept {
    return lit.positive() == (costs_are_ == Costs::positive);
  }
  /// An obstacle that keeps an agent off the goal of another one that costs less than `cost`.
  struct GoalObstacle {
    AgentId agent, resident;
    VertexId goal;
    Cost cost;
    ObstacleId obstacle;
  };
  /// All that were made, in that order.
  [[nodiscard]] const std::vector<GoalObstacle>& goal_obstacles() const { return goal_obstacles_; }
  /// The literal "nobody ends at the goal". By itself it says nothing: see `take`.
  [[nodiscard]] sat::Lit left_over(VertexId goal, FormulaWriter& writer);
  /// Writes that the goal is left over, or somebody ends there. `elsewhere`: of each agent that can
  /// end there the obstacle that forbids to end at another goal, each with its usage literal.
  struct MayEndElsewhere {
    AgentId agent;
    ObstacleId obstacle;
    sat::Lit allowed;
  };
  void take(VertexId goal, std::span<const MayEndElsewhere> elsewhere, FormulaWriter& writer);

  /// The positive literals of all usage, cost and rest variables, in the order in which they were
  /// made.
  [[nodiscard]] std::vector<sat::Lit> literals() const;

 protected:
  /// Which literal of its variable "costs this or more" is. Variables are false by default: so
  /// agents are cheap by default if it is the positive one.
  enum class Costs { positive, negative };
  Vocabulary(std::size_t num_agents, Costs costs_are)
      : costs_are_(costs_are), ladders_(num_agents) {}

  /// The literal of a new obstacle.
  [[nodiscard]] sat::Lit new_usage(AgentId agent, ObstacleId obstacle, FormulaWriter& writer);
  /// A new variable of the domain, positive.
  [[nodiscard]] sat::Lit new_own(AgentId agent, std::uint32_t own, FormulaWriter& writer);
  /// That an agent rests at a goal and costs less than `cost`.
  struct Rest {
    AgentId resident;
    VertexId goal;
    Cost cost = 0;
    /// The usage literal "it may end at the goal". Invalid: it cannot end elsewhere.
    sat::Lit may_end = {};
  };
  /// The obstacle that keeps `agent` away from the goal during that rest, and whether it is new:
  /// then `make` has made it, which is told its literal.
  template <class Make>
  std::pair<ObstacleId, bool> goal_obstacle(AgentId agent, const Rest& rest, FormulaWriter& writer,
                                            const Make& make) {
    const auto key = std::make_tuple(agent, rest.resident, rest.goal, rest.cost);
    if (const auto known = goals_.find(key); known != goals_.end()) return {known->second, false};
    const ObstacleId made = make(rest.may_end.valid() ? ~rests(rest, writer)
                                                      : at_least(rest.resident, rest.cost, writer));
    goals_.emplace(key, made);
    goal_obstacles_.push_back({agent, rest.resident, rest.goal, rest.cost, made});
    return {made, true};
  }

 private:
  [[nodiscard]] Rung& rung(AgentId agent, Cost cost, FormulaWriter& writer);
  /// The literal of kind rest.
  [[nodiscard]] sat::Lit rests(const Rest& rest, FormulaWriter& writer);
  void remember(sat::Lit lit, const Variable& variable);

  const Costs costs_are_;
  IdVector<AgentId, std::vector<Rung>> ladders_;
  std::map<std::tuple<AgentId, AgentId, VertexId, Cost>, ObstacleId> goals_;
  std::map<std::tuple<AgentId, VertexId, Cost>, sat::Lit> rests_;
  std::map<VertexId, sat::Lit> left_over_;
  std::vector<GoalObstacle> goal_obstacles_;
  std::vector<Variable> variables_;  // by variable
};

}  // namespace quadrille::lazy

QUADRILLE_API_END
