// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "paths/bans.hpp"
#include "paths/scene.hpp"
#include "quadrille/sat/lemma.hpp"
#include "quadrille/sat/obstacle_trail.hpp"

namespace quadrille::continuous {

using sat::ObstacleId;

/// Where new literals and clauses go: to the engine between solves, or to it by way of the theory.
class FormulaWriter {
 public:
  virtual ~FormulaWriter() = default;
  [[nodiscard]] virtual sat::Lit new_lit() = 0;
  virtual void add(const sat::Lemma& lemma) = 0;
};

/// Bans that hold for `agent` while the literal `allowed` is false.
struct Obstacle {
  AgentId agent;
  sat::Lit allowed;
  std::vector<Ban> bans;
  std::vector<AgentId> partners;  ///< Agents whose moves and stays these bans keep clear of.
  /// Of the bans, that of the move or stay that collided when the obstacle was made.
  Ban cause = {};
};

/// The literals and what they mean.
///
/// - Usage literals, one per set of bans: "the agent may do some of this". False: it does none.
/// - Ordered cost literals "the agent arrives for the last time at tick c or later".
/// - That others keep away from an agent's goal from c on is active while "the agent arrives at c
///   or later" is false, without a literal of its own.
/// In every valid plan, let cost literals be true as the arrivals say, and a usage literal be true
/// if and only if the agent breaks one of its bans: every clause that this folder makes holds then.
/// Not so the cores that a cost search adds: they hold in every plan that is cheaper than its
/// incumbent, and with them all that the solver derives (docs/soundness/continuous.md, 11.13).
/// Incumbents only become cheaper, so that what held relative to one holds relative to the next.
///
/// In lemmas, the resource number of a usage is the index of its obstacle.
class Model {
 public:
  /// `scene` is complete and outlives the model.
  explicit Model(Scene& scene);

  [[nodiscard]] Scene& scene() noexcept { return scene_; }
  // Of the scene:
  [[nodiscard]] const Instance& instance() const noexcept { return scene_.instance(); }
  [[nodiscard]] LimitMonitor& limits() noexcept { return scene_.limits(); }
  [[nodiscard]] Contacts& contacts() noexcept { return scene_.contacts(); }
  [[nodiscard]] PathTask task(AgentId i) const { return scene_.task(i); }
  [[nodiscard]] const std::vector<Ban>& standing_bans(AgentId i) const {
    return scene_.standing_bans(i);
  }
  [[nodiscard]] Cost free_cost(AgentId i) const { return scene_.free_cost(i); }
  [[nodiscard]] const IdVector<ObstacleId, Obstacle>& obstacles() const noexcept {
    return obstacles_;
  }

  /// The literal "the agent costs `cost` or more". Requires cost > free_cost.
  [[nodiscard]] sat::Lit at_least(AgentId agent, Cost cost, FormulaWriter& writer);
  /// The same, for a search that caps the agent's cost at `cap`: at_least(agent, cap + 1).
  [[nodiscard]] sat::Lit above(AgentId agent, Cost cap, FormulaWriter& writer);
  struct Threshold {
    Cost cost;
    sat::Lit at_least;
    /// A lemma speaks of it. No lemma speaks of thresholds that were made for caps: so what is
    /// refuted for one of those is refuted for the next natural one.
    bool is_natural;
  };
  /// All that were made, by increasing cost.
  [[nodiscard]] const std::vector<Threshold>& thresholds(AgentId agent) const {
    return thresholds_[agent];
  }

  /// The obstacle with these bans, made at the first call. `is_new` tells. `partner` joins its
  /// partners.
  [[nodiscard]] ObstacleId usage(AgentId agent, std::vector<Ban> bans, AgentId partner,
                                 FormulaWriter& writer, bool& is_new);
  /// Keeps `agent` away from the goal of `resident` from `tick` on while that costs less.
  [[nodiscard]] ObstacleId keep_off_goal(AgentId agent, AgentId resident, Ticks tick,
                                         FormulaWriter& writer, bool& is_new);

  enum class VariableKind { auxiliary, usage, cost };
  struct Variable {
    VariableKind kind = VariableKind::auxiliary;
    AgentId agent;
    Cost cost = 0;        // cost: true says "costs this or more"
    ObstacleId obstacle;  // usage: true says that it is forbidden
  };
  /// auxiliary for variables that are not of this model.
  [[nodiscard]] Variable variable(sat::Lit lit) const;
  /// The positive literals of all usage and cost variables, in the order in which they were made.
  [[nodiscard]] const std::vector<sat::Lit>& literals() const noexcept { return literals_; }

 private:
  [[nodiscard]] Threshold& threshold(AgentId agent, Cost cost, FormulaWriter& writer);
  void remember(sat::Lit lit, const Variable& variable);

  Scene& scene_;
  IdVector<ObstacleId, Obstacle> obstacles_;
  IdVector<AgentId, std::vector<Threshold>> thresholds_;
  std::map<std::pair<AgentId, std::vector<Ban>>, ObstacleId> usages_;
  std::map<std::tuple<AgentId, AgentId, Ticks>, ObstacleId> goals_;
  std::vector<Variable> variables_;  // by variable
  std::vector<sat::Lit> literals_;
};

}  // namespace quadrille::continuous
