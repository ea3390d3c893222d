// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "joint/joint_groups.hpp"
#include "paths/scene.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/core/progress.hpp"
#include "solve/inheritance.hpp"

namespace quadrille::continuous {

/// The phases of one solve, one after the other until the bounds meet: what comes before the search
/// for the least cost, and that search.
class Phases {
 public:
  /// `account`: that of `limits`. What is found and proved goes into `outcome`. All outlive this.
  Phases(const Instance& instance, const SolveOptions& options, const Inheritance& inheritance,
         LimitMonitor& limits, const std::shared_ptr<ResourceAccount>& account,
         SolveOutcome& outcome)
      : instance_(instance),
        options_(options),
        inheritance_(inheritance),
        limits_(limits),
        account_(account),
        outcome_(outcome),
        progress_(options.on_progress, options.progress_interval_s, limits),
        known_(options.known_lower_bound.value_or(0)) {}

  /// Throws LimitReached, with what is known in the outcome, and what callbacks throw.
  void run();

 private:
  /// Null: a limit was met, and what the agents cost when each is alone is learnt.
  [[nodiscard]] std::unique_ptr<Scene> make_scene();
  /// Each returns whether that is all.
  [[nodiscard]] bool are_kept_off(const Scene& scene);
  [[nodiscard]] bool take_inheritance(Scene& scene);
  [[nodiscard]] bool search_jointly(Scene& scene, const std::vector<JointGroup>& groups);
  [[nodiscard]] bool look_at_routes(Scene& scene);
  [[nodiscard]] bool find_some_plan(Scene& scene, bool was_joint);
  [[nodiscard]] bool is_blocked(const std::vector<AgentId>& blocked);
  [[nodiscard]] bool learn(Cost bound, std::optional<Plan> plan);

  /// Proved or known.
  [[nodiscard]] Cost lower() const { return std::max(floor_, known_); }

  /// What a group costs, and the others when each is alone.
  [[nodiscard]] Cost bound_of_all(const Scene& scene, const GroupBound& group) const;
  void search(Scene& scene);
  void keep_cheaper(std::optional<Plan> plan);
  void enter(Phase phase);

  const Instance& instance_;
  const SolveOptions& options_;
  const Inheritance& inheritance_;
  LimitMonitor& limits_;
  const std::shared_ptr<ResourceAccount>& account_;
  SolveOutcome& outcome_;
  ProgressReporter progress_;
  std::optional<Plan> plan_;  // the cheapest one
  Cost floor_ = 0;            // proved
  const Cost known_;          // by the user
};

}  // namespace quadrille::continuous
