// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "paths/bans.hpp"
#include "quadrille/lazy/vocabulary.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

using lazy::FormulaWriter;
using lazy::ObstacleId;

/// Bans that hold for `agent` while the literal `allowed` is false.
struct Obstacle {
  AgentId agent;
  sat::Lit allowed;
  std::vector<Ban> bans;
  std::vector<AgentId> partners;  ///< Agents whose moves and stays these bans keep clear of.
  /// Of the bans, that of the move or stay that collided when the obstacle was made.
  Ban cause = {};
};

/// The literals of continuous time and what they mean: obstacles are sets of bans, costs the ticks
/// at which agents arrive for the last time.
///
/// In every valid plan, let cost literals be true as the arrivals say, and a usage literal be true
/// if and only if the agent breaks one of its bans: every clause that this folder makes holds then.
/// Not so the cores that a cost search adds: they hold in every plan that is cheaper than its
/// incumbent, and with them all that the solver derives (docs/soundness/continuous.md, 11.13).
/// Incumbents only become cheaper, so that what held relative to one holds relative to the next.
class Model final : public lazy::Vocabulary {
 public:
  /// `scene` is complete and outlives the model.
  explicit Model(Scene& scene);

  [[nodiscard]] Scene& scene() noexcept { return scene_; }
  [[nodiscard]] const Scene& scene() const noexcept { return scene_; }
  // Of the scene:
  [[nodiscard]] const Instance& instance() const noexcept { return scene_.instance(); }
  [[nodiscard]] LimitMonitor& limits() noexcept { return scene_.limits(); }
  [[nodiscard]] Contacts& contacts() noexcept { return scene_.contacts(); }
  [[nodiscard]] PathTask task(AgentId i) const { return scene_.task(i); }
  [[nodiscard]] const std::vector<Ban>& standing_bans(AgentId i) const {
    return scene_.standing_bans(i);
  }
  [[nodiscard]] Cost free_cost(AgentId i) const override { return scene_.free_cost(i); }
  [[nodiscard]] Cost cost_bound(AgentId i) const override {
    return as_cost(arrival_bound(instance(), i));
  }
  [[nodiscard]] const IdVector<ObstacleId, Obstacle>& obstacles() const noexcept {
    return obstacles_;
  }

  /// The obstacle with these bans, made at the first call. `is_new` tells. `partner` joins its
  /// partners.
  [[nodiscard]] ObstacleId usage(AgentId agent, std::vector<Ban> bans, AgentId partner,
                                 FormulaWriter& writer, bool& is_new);
  /// Keeps `agent` away from a goal of `resident` from `tick` on while that ends there and costs
  /// less.
  [[nodiscard]] ObstacleId keep_off_goal(AgentId agent, AgentId resident, VertexId goal, Ticks tick,
                                         FormulaWriter& writer, bool& is_new);
  /// That `agent` may end at one of its goals. `partner` as for usages.
  [[nodiscard]] ObstacleId end(AgentId agent, VertexId goal, AgentId partner, FormulaWriter& writer,
                               bool& is_new) {
    return usage(agent, {Ban::end(goal)}, partner, writer, is_new);
  }
  /// Writes that somebody ends at the goal, unless it is left over.
  void take(VertexId goal, FormulaWriter& writer);
  using Vocabulary::take;

 private:
  /// Of that obstacle.
  [[nodiscard]] std::vector<Ban> goal_bans(AgentId agent, AgentId resident, VertexId goal,
                                           Ticks tick);

  Scene& scene_;
  IdVector<ObstacleId, Obstacle> obstacles_;
  std::map<std::pair<AgentId, std::vector<Ban>>, ObstacleId> usages_;
};

}  // namespace quadrille::continuous
