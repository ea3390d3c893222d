// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/grouping.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/solve/knowledge.hpp"
#include "quadrille/solve/pulse.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::solve {

/// The same groups, with all that are alone in one group: their search is short, its set-up is not.
[[nodiscard]] AgentGroups with_lone_agents_together(AgentGroups groups);

/// Puts what is known of groups, alone, together: what agents cost, raises and sites. `bounds`: the
/// lower bounds of the groups. See Attribution for what that claims.
[[nodiscard]] Attribution joined(Objective objective, const AgentGroups& groups,
                                 const std::vector<Attribution>& attributions,
                                 std::span<const Cost> bounds);

/// A solve of groups of agents that have nothing to do with each other, each by a search of its own
/// (docs/soundness/cost.md, "Independent groups"). They take turns, the last open one without end:
/// first each as far as its first plan, then with limits of conflicts that grow, so that one hard
/// group does not keep the others from a plan. A search that comes again begins with the plan and
/// the bound that it had. For the makespan, a group whose plan takes no longer than the bound of
/// another one is not searched further. A limit of conflicts holds for all together, but for one
/// more for each group, so that each comes to its first plan.
///
/// `Domain` supplies:
///
///     Plan, Options
///     cost(plan, objective)
///     search_of(agents)     the search of a group, whose agents are 0, 1, .. there, a function of
///                           (options, limits, known, pulse) that are the group's
///     told(infeasibility)   what is said of agents that block each other, the others besides
template <class Domain>
class Apart {
 public:
  using Plan = typename Domain::Plan;
  using Options = typename Domain::Options;
  using Pulse = solve::Pulse<Plan>;
  using Known = Knowledge<Plan>;
  using Search = std::function<void(const Options&, LimitMonitor&, Known&, Pulse&)>;

  /// `account`: that of `limits`. `known` and `pulse` are those of the whole. All outlive this.
  Apart(const Domain& domain, const Options& options,
        const std::shared_ptr<ResourceAccount>& account, LimitMonitor& limits, Known& known,
        Pulse& pulse)
      : domain_(domain),
        options_(options),
        account_(account),
        limits_(limits),
        known_(known),
        pulse_(pulse) {}

  /// Leaves all that is found out in `known`. Throws what callbacks throw.
  void run(const AgentGroups& groups) {
    for (const std::vector<AgentId>& agents : groups) {
      parts_.push_back({agents, domain_.search_of(agents)});
      if (known_.plan) take_part_of_plan(parts_.back());
    }
    for (std::int64_t conflicts = 1; !is_over(); conflicts = std::max(kFirst, kGrowth * conflicts))
      for (Part& part : parts_) {
        if (is_over()) break;
        if (!is_open(part)) continue;
        search(part, num_open() == 1 ? std::nullopt : std::optional(conflicts));
      }
    if (options_.explain) explain(groups);
  }

 private:
  /// What is searched again is a third of the whole at most.
  static constexpr std::int64_t kFirst = 1000, kGrowth = 4;

  struct Part {
    const std::vector<AgentId>& agents;
    Search search;
    Known known = {};
    bool has_begun = false;
    bool is_stuck = false;  // its search ended by itself, without a proof
  };

  [[nodiscard]] bool is_open(const Part& part) const {
    if (part.is_stuck) return false;
    if (!part.known.cost) return true;
    const Cost lower = options_.objective == Objective::makespan
                           ? std::max(part.known.lower(), known_.lower())
                           : part.known.lower();
    return *part.known.cost > lower &&
           !is_within_gap(options_.gap_percent, *part.known.cost, lower);
  }
  [[nodiscard]] std::ptrdiff_t num_open() const {
    return std::count_if(parts_.begin(), parts_.end(),
                         [this](const Part& part) { return is_open(part); });
  }
  [[nodiscard]] bool have_all_begun() const {
    return std::all_of(parts_.begin(), parts_.end(),
                       [](const Part& part) { return part.has_begun; });
  }
  [[nodiscard]] bool is_over() const {
    return known_.error || known_.infeasible || limits_.reason() != StopReason::none ||
           num_open() == 0;
  }

  void search(Part& part, std::optional<std::int64_t> conflicts) {
    const auto left = conflicts_left(part);
    if (left) conflicts = std::min(*left, conflicts.value_or(*left));
    Options options = options_of(part, conflicts);
    LimitMonitor limits(options.limits, account_);
    std::int64_t counted = 0;
    const auto look = [&] {
      limits_.add_conflicts(limits.conflicts() - std::exchange(counted, limits.conflicts()));
      learn();
    };
    options.on_progress = [&](const Progress& progress) {
      look();
      if (std::exchange(phase_, progress.phase) != progress.phase) pulse_.enter(progress.phase);
      pulse_.beat();
    };
    // Progress is told when it is due, which depends on the clock; a search ends at yield points.
    const auto is_enough = [&] {
      look();
      pulse_.consider_stop();
      return limits_.reason() != StopReason::none || !is_open(part);
    };
    part.has_begun = true;
    Known& own = part.known;
    own.stop = StopReason::none;
    own.why_open.clear();
    own.statistics = {.first_plan = std::move(own.statistics.first_plan)};
    {
      Pulse pulse(options, limits, own, true, is_enough);
      run_guarded(own, limits, [&] { part.search(options, limits, own, pulse); });
    }
    own.prove(own.lower());  // nobody claims anything of a group
    known_.statistics.add_counts(own.statistics);
    look();
    take_end(part, left && conflicts == left);
    pulse_.beat();
  }

  /// Of the limit that the user gave.
  [[nodiscard]] std::optional<std::int64_t> conflicts_left(const Part& part) const {
    if (!options_.limits.conflicts) return std::nullopt;
    const std::int64_t all = *options_.limits.conflicts;
    return std::max<std::int64_t>(all - limits_.conflicts(), all > 0 && !part.has_begun ? 1 : 0);
  }
  [[nodiscard]] Options options_of(const Part& part, std::optional<std::int64_t> conflicts) const {
    Options options = options_;
    options.initial_plan.reset();
    options.known_lower_bound.reset();
    options.on_plan = {};
    if (options_.debug.known_plan)
      options.debug.known_plan = part_of(part.agents, *options_.debug.known_plan);
    options.limits.conflicts = conflicts;
    return options;
  }

  /// `has_none_left`: it had all conflicts that were left of the user's limit.
  void take_end(Part& part, bool has_none_left) {
    Known& own = part.known;
    if (own.error) known_.error = own.error;
    if (own.infeasible) {
      for (AgentId& i : own.infeasible->blocked) i = part.agents[i.index()];
      known_.infeasible = domain_.told(*std::move(own.infeasible));
      return;
    }
    // In a race whoever has a proof may have been stopped by another one that has one, too.
    if (!is_open(part)) return;
    switch (own.stop) {
      case StopReason::none:
        part.is_stuck = true;
        known_.why_open = own.why_open;
        return;
      case StopReason::gap:
        return;
      case StopReason::conflicts:
        // Of its turn, or of all: then those that have not begun come to their first plans.
        if (has_none_left && (*options_.limits.conflicts == 0 || have_all_begun()))
          limits_.stop(StopReason::conflicts);
        return;
      default:
        limits_.stop(own.stop);
    }
  }

  /// What the groups know is known of the whole.
  void learn() {
    Cost bound = 0, cost = 0;
    bool have_floors = true, have_plans = true;
    for (const Part& part : parts_) {
      add(bound, part.known.lower());
      add(cost, part.known.cost.value_or(0));
      have_floors = have_floors && part.known.has_floor;
      have_plans = have_plans && part.known.cost;
    }
    if (have_floors)
      known_.prove(bound);
    else
      known_.raise(bound);
    if (!have_plans || (known_.cost && *known_.cost <= cost)) return;
    const bool is_first = !known_.plan;
    Plan plan;
    plan.paths.resize(num_agents());
    for (const Part& part : parts_)
      for (std::size_t k = 0; k < part.agents.size(); ++k)
        plan.paths[part.agents[k]] = part.known.plan->paths[AgentId(k)];
    known_.take(std::make_shared<const Plan>(std::move(plan)), cost);
    if (is_first) known_.credit(parts_.front().known.statistics.first_plan);
  }
  void add(Cost& all, Cost of_part) const {
    all = options_.objective == Objective::sum_of_costs ? all + of_part : std::max(all, of_part);
  }
  [[nodiscard]] std::size_t num_agents() const {
    std::size_t number = 0;
    for (const Part& part : parts_) number += part.agents.size();
    return number;
  }

  [[nodiscard]] static Plan part_of(const std::vector<AgentId>& agents, const Plan& plan) {
    Plan part;
    for (const AgentId i : agents) part.paths.push_back(plan.paths[i]);
    return part;
  }
  void take_part_of_plan(Part& part) {
    Plan plan = part_of(part.agents, *known_.plan);
    const Cost cost = Domain::cost(plan, options_.objective);
    part.known.take(std::make_shared<const Plan>(std::move(plan)), cost);
    part.known.credit("given");
  }

  void explain(const AgentGroups& groups) {
    std::vector<Attribution> attributions;
    std::vector<Cost> bounds;
    for (Part& part : parts_) {
      if (!part.known.attribution) return;  // the search was cut before anything was known
      attributions.push_back(*std::move(part.known.attribution));
      bounds.push_back(part.known.lower());
    }
    known_.attribution = joined(options_.objective, groups, attributions, bounds);
  }

  const Domain& domain_;
  const Options& options_;
  const std::shared_ptr<ResourceAccount>& account_;
  LimitMonitor& limits_;
  Known& known_;
  Pulse& pulse_;
  std::vector<Part> parts_;
  Phase phase_ = Phase::set_up;
};

}  // namespace quadrille::solve

QUADRILLE_API_END
