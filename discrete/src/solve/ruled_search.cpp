// SPDX-License-Identifier: MIT
#include "solve/ruled_search.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/discrete/plan_improver.hpp"
#include "quadrille/discrete/primal.hpp"
#include "ruled/turning_order.hpp"
#include "solve/plan_search.hpp"

namespace quadrille::discrete {
namespace {

/// How long a first plan is looked for before the search, in how many attempts, in which slices,
/// and the share of the search's effort that plans get beside it.
constexpr Effort kMostFirst = Effort::microseconds(1'000'000), kSlice = Effort::microseconds(6'250);
constexpr std::int64_t kMostAttempts = 32, kShare = 8;
/// Where agents turn, what so many orders of agents have not found is left to a plan without turns.
constexpr std::int64_t kAttemptsWithTurns = 4;
/// For making that plan cheaper before turns are added, by its sum of costs; and in how many parts.
constexpr std::int64_t kStepsByCost = 512, kParts = 16;
/// What so many orders of agents have not found, others do not find either.
constexpr std::int64_t kLastAttempt = 4096;

}  // namespace

bool RuledSearch::is_first_plan_due() const {
  return !incumbent_.upper() && (may_add_turns() || (plans_.effort() < steps_of_plans(kMostFirst) &&
                                                     plans_.num_attempts() < kMostAttempts));
}

Effort RuledSearch::work() {
  const std::int64_t before = plans_.effort(), steps = steps_of_plans(kSlice);
  if (!incumbent_.upper() && may_add_turns() && plans_.num_attempts() >= kAttemptsWithTurns)
    return std::max(kSlice, add_turns());
  if (!incumbent_.upper()) {
    if (plans_.num_attempts() < kLastAttempt && plans_.find(steps))
      incumbent_.offer(plans_.plan(), "prioritised");
  } else {
    if (!plans_.has_plan() || *incumbent_.upper() < plans_.cost())
      plans_.restart_from(incumbent_.plan());
    if (plans_.improve(steps)) incumbent_.offer(plans_.plan(), "improvement");
  }
  return std::max(kSlice, effort_of_plans(plans_.effort() - before));
}

Effort RuledSearch::add_turns() {
  has_added_turns_ = true;
  Rules rules = instance_.rules();
  rules.turn = 0;
  const auto without = instance_.with_rules(std::move(rules));
  if (!without || !without->is_plain()) return {};
  const auto plan = find_plan(*without, limits_, seed_);
  if (!plan) return {};
  incumbent_.offer(with_turns(instance_, *plan), "turns added");
  // The less a plan jams, the fewer wait for those who turn.
  PlanImprover improver(*without, distances_, objective_, *plan, seed_);
  const std::int64_t part = kStepsByCost * plan->cost(Objective::sum_of_costs) / kParts;
  for (std::int64_t k = 0; k < kParts && !limits_.exhausted_now(); ++k)
    if (improver.improve(part, limits_))
      incumbent_.offer(with_turns(instance_, improver.plan()), "turns added");
  return effort_of_plans(improver.effort());
}

void RuledSearch::advance(Effort search_effort, const std::function<void()>& after_slice) {
  credit_ += (search_effort - seen_effort_) / kShare;
  seen_effort_ = search_effort;
  for (; credit_ >= kSlice && !incumbent_.are_closed(); after_slice()) credit_ -= work();
}

}  // namespace quadrille::discrete
