// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "neighbourhoods/neighbourhoods.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/plan_improver.hpp"
#include "reservations/path_planner.hpp"
#include "reservations/reservations.hpp"

namespace quadrille::discrete {

class PlanImprover::Impl {
 public:
  Impl(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
       Objective objective, const Plan& plan, std::uint32_t seed);

  bool step(LimitMonitor& limits);
  bool improve(std::int64_t effort, LimitMonitor& limits, Cost target);
  void restart_from(const Plan& plan);
  [[nodiscard]] const Plan& plan() const noexcept { return plan_; }
  [[nodiscard]] Cost cost() const noexcept {
    return objective_ == Objective::sum_of_costs ? sum_ : makespan_;
  }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }
  [[nodiscard]] bool is_ideal() const noexcept { return !has_prices_ && sum_ == ideal_sum_; }

 private:
  using Rule = Neighbourhoods::Rule;
  static constexpr std::size_t kNumRules = 3;
  static constexpr std::array<std::size_t, 5> kSizes{2, 4, 8, 16, 32};
  /// A rule and a size, with what they gained lately per effort (scaled).
  struct Choice {
    Rule rule;
    std::size_t size;
    std::int64_t score = 0;
    std::int64_t explored = 0;  // Effort for it when it was its turn, whatever its score.
  };

  /// What the new paths of a neighbourhood may cost.
  struct Budget {
    Timestep latest = 0;  // No agent may arrive later.
    Cost sum = 0;         // Of the arrivals.
  };

  Choice& least_explored();
  Choice& draw_choice();
  AgentId draw_seed();
  [[nodiscard]] Budget budget_of(const std::vector<AgentId>& agents) const;
  Cost replace_paths(const std::vector<AgentId>& agents, LimitMonitor& limits);
  bool replan(const std::vector<AgentId>& agents, LimitMonitor& limits);
  void put_back(const std::vector<AgentId>& agents, std::size_t num_new);
  void count_costs();
  [[nodiscard]] Cost distance(AgentId agent) const {
    return (*distances_)(agent, instance_.agents()[agent].start);
  }
  [[nodiscard]] Cost cost_of(AgentId agent) const {
    return static_cast<Cost>(plan_.paths[agent].size()) - 1;
  }
  /// With the price of its goal, if there are prices.
  [[nodiscard]] Cost priced_cost_of(AgentId agent) const {
    return cost_of(agent) + distances_->price(plan_.paths[agent].back());
  }

  Instance instance_;
  std::shared_ptr<const GoalDistances> distances_;
  Objective objective_;
  Random random_;
  Plan plan_;
  Cost sum_ = 0, makespan_ = 0, ideal_sum_ = 0;
  Reservations reservations_;
  PathPlanner planner_;
  Neighbourhoods neighbourhoods_;
  std::vector<Choice> choices_;
  std::vector<char> was_seed_;   // By agent: since all delayed agents had been seeds.
  std::vector<Path> old_paths_;  // Of the neighbourhood.
  std::int64_t effort_ = 0, explored_ = 0;
  bool has_prices_ = false;
  bool was_rebuilt_ = false;  // Was the neighbourhood of all agents tried?
};

}  // namespace quadrille::discrete
