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
#include "quadrille/lazy/vocabulary.hpp"

namespace quadrille::discrete {

using lazy::FormulaWriter;

/// The literals of the lazy path model of the discrete domain and what they mean: its obstacles,
/// and literals of explicit paths.
class LazyModel final : public lazy::Vocabulary {
 public:
  /// Requires that all agents have a path when they are alone, and the distances of `instance`,
  /// which outlives the model. With prices, which are those of the distances, costs include them.
  /// `left_over`: the goals with prices that plans need not use.
  LazyModel(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
            std::shared_ptr<const GoalPrices> prices = nullptr,
            std::vector<VertexId> left_over = {});

  [[nodiscard]] const Instance& instance() const noexcept { return instance_; }
  [[nodiscard]] const AgentDistances& distances(AgentId agent) const {
    return distances_[agent.index()];
  }
  [[nodiscard]] const ObstacleTable& obstacles() const noexcept { return obstacles_; }
  /// Of a goal.
  [[nodiscard]] Timestep price(VertexId goal) const { return prices_ ? (*prices_)[goal] : 0; }
  /// The goals with prices that plans need not use.
  [[nodiscard]] const std::vector<VertexId>& may_be_left_over() const noexcept {
    return left_over_;
  }

  [[nodiscard]] Cost free_cost(AgentId agent) const override {
    return distances(agent).free_cost();
  }
  [[nodiscard]] Cost cost_bound(AgentId agent) const override {
    const auto deadline = distances(agent).deadline();
    return deadline ? Cost{*deadline} + 1 : lazy::kNoCap;
  }
  /// The literal "the agent costs more than `cost`". Requires cost >= the free cost.
  [[nodiscard]] sat::Lit cost_above(AgentId agent, Timestep cost, FormulaWriter& writer) {
    return at_least(agent, Cost{cost} + 1, writer);
  }

  // The obstacle of a usage, made at the first call. Different agents' points (windows, edges,
  // ends) of the same place and time exclude each other by clauses that come with them.
  [[nodiscard]] ObstacleId point(AgentId agent, Visit visit, FormulaWriter& writer);
  /// Being in `v` at any timestep from `first` on that is too near to it for another agent to be
  /// there; where rules do not keep agents apart in time, a point.
  [[nodiscard]] ObstacleId window(AgentId agent, VertexId v, Timestep first, FormulaWriter& writer);
  [[nodiscard]] ObstacleId edge(AgentId agent, VertexId u, VertexId v, Timestep t,
                                FormulaWriter& writer);
  [[nodiscard]] ObstacleId range(AgentId agent, VertexId v, Timestep first, Timestep last,
                                 FormulaWriter& writer);
  /// All that the agent can do of a sweep along one line of a grid: its first and last visit tell
  /// the others.
  [[nodiscard]] ObstacleId barrier(AgentId agent, std::span<const Visit> visits,
                                   FormulaWriter& writer);
  /// End in that goal, for an agent that shares it with others: of these only one may.
  [[nodiscard]] ObstacleId end(AgentId agent, VertexId goal, FormulaWriter& writer);
  /// End in any goal but that one.
  [[nodiscard]] ObstacleId elsewhere(AgentId agent, VertexId goal, FormulaWriter& writer);
  /// Writes that somebody ends at the goal, unless it is left over.
  void take(VertexId goal, FormulaWriter& writer);
  using Vocabulary::take;
  /// Keeps `agent` away from a goal of `resident` from its timestep on, or as long before as rules
  /// ask for, while that rests there and costs no more than if it had arrived then.
  ObstacleId keep_off_goal(AgentId agent, AgentId resident, Visit goal, FormulaWriter& writer);

  /// The literal "the agent is in that vertex at that timestep", or at rest there if it is its
  /// goal: of an explicit path. Made anew at each call.
  [[nodiscard]] sat::Lit new_vertex(AgentId agent, Visit visit, FormulaWriter& writer);

  /// Of a cost variable: the k of "the agent costs more than k", and of its opposite.
  [[nodiscard]] static Timestep cap(const Variable& cost) {
    return static_cast<Timestep>(cost.cost - 1);
  }
  /// Of a variable of new_vertex, which are the only ones of kind own.
  [[nodiscard]] Visit visit(const Variable& own) const { return visits_[own.own]; }

 private:
  using Users = std::vector<ObstacleId>;
  sat::Lit make_usage(AgentId agent, FormulaWriter& writer) {
    return new_usage(agent, ObstacleId(obstacles_.size()), writer);
  }
  [[nodiscard]] std::optional<ObstacleId> find_user(const Users& users, AgentId agent) const;
  /// Adds to the users of a place and time, of whom only one may be there.
  void join(Users& users, ObstacleId newcomer, const sat::Why& why, FormulaWriter& writer);

  const Instance& instance_;
  std::shared_ptr<const GoalDistances> goal_distances_;
  std::shared_ptr<const GoalPrices> prices_;
  std::vector<VertexId> left_over_;
  std::shared_ptr<const BlockedTimes> blocked_;  // Null: nothing is.
  std::vector<AgentDistances> distances_;
  ObstacleTable obstacles_;
  std::unordered_map<std::uint64_t, Users> points_, windows_;
  std::map<std::tuple<VertexId, VertexId, Timestep>, Users> edges_;
  std::map<VertexId, Users> ends_;
  std::map<std::tuple<AgentId, VertexId, Timestep, Timestep>, ObstacleId> ranges_;
  std::map<std::pair<AgentId, VertexId>, ObstacleId> elsewheres_;
  std::map<std::tuple<AgentId, Visit, Visit>, ObstacleId> barriers_;
  std::vector<Visit> visits_;  // of the literals of explicit paths
};

}  // namespace quadrille::discrete
