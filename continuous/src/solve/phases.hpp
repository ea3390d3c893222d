// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "certificate/certify.hpp"
#include "joint/joint_groups.hpp"
#include "quadrille/continuous/solver.hpp"
#include "solve/desk.hpp"
#include "solve/warm_start.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// What is said of agents that cannot all reach their goals; one: not even alone.
[[nodiscard]] solve::Infeasibility infeasibility(const Instance& instance,
                                                 const std::vector<AgentId>& blocked);

/// The phases of one solve, one after the other until the bounds meet: what comes before the search
/// for the least cost, and that search.
class Phases {
 public:
  /// `account`: that of the limits of `desk`, where all that is found and proved is left. `proof`:
  /// see search_side_by_side. All outlive this.
  Phases(const Instance& instance, const SolveOptions& options, const WarmStart& warm,
         const std::shared_ptr<ResourceAccount>& account, const Desk& desk,
         std::optional<ProofDraft>& proof)
      : instance_(instance),
        options_(options),
        warm_(warm),
        account_(account),
        desk_(desk),
        known_(desk.known),
        proof_(proof) {}

  /// Besides what agents cost, of sums of costs. To be called before `run`.
  void set_fees(const std::vector<Fee>& fees) { fees_ = fees; }
  /// Throws LimitReached, and what callbacks throw.
  void run();

 private:
  /// Each returns whether that is all.
  [[nodiscard]] bool are_kept_off(const Scene& scene);
  [[nodiscard]] bool take_warm_start(Scene& scene);
  [[nodiscard]] bool search_jointly(Scene& scene, const std::vector<JointGroup>& groups);
  [[nodiscard]] bool look_at_routes(Scene& scene);
  [[nodiscard]] bool find_some_plan(Scene& scene, bool was_joint);
  // Searches that have to know where agents end.
  void move_one_by_one(Scene& scene);
  void search_longer(Scene& scene);
  /// Where agents have a choice, one is made for them.
  void with_one_goal_each(Scene& scene, void (Phases::*search)(Scene&));
  [[nodiscard]] bool is_blocked(const std::vector<AgentId>& blocked);
  /// `source`: where the plan came from.
  [[nodiscard]] bool learn(const Scene& scene, Cost bound, std::optional<Plan> plan,
                           const char* source);

  /// What of a bound counts that no clauses prove: a certificate would say nothing of it.
  [[nodiscard]] Cost unless_proof(Cost bound) const {
    return options_.proof ? known_.floor : bound;
  }
  void keep_cheaper(const Scene& scene, std::optional<Plan> plan, const char* source);

  const Instance& instance_;
  const SolveOptions& options_;
  const WarmStart& warm_;
  const std::shared_ptr<ResourceAccount>& account_;
  const Desk desk_;
  Knowledge& known_;
  std::optional<ProofDraft>& proof_;
  std::vector<Fee> fees_;
};

}  // namespace quadrille::continuous
