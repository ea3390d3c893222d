// SPDX-License-Identifier: MIT
#include "solve/plan_search.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// Of a search for a first plan that nothing else runs beside, and of its slices.
constexpr std::int64_t kFirstEffort = 20'000'000, kFirstSlice = 200'000;
/// Over each path of a draft: copied, reserved, taken out again.
constexpr std::int64_t kPasses = 5;

}  // namespace

sat::Outcome FirstPlan::advance(sat::Slice slice) {
  QUADRILLE_REQUIRE(slice.effort.has_value(), "the slice has an end");
  if (search_.advance(*slice.effort, context_.limits) == PrimalSearch::State::found)
    context_.incumbent.offer(search_.plan());
  return sat::Outcome::working;
}

sat::Outcome PlanImprovement::advance(sat::Slice slice) {
  QUADRILLE_REQUIRE(slice.effort.has_value(), "the slice has an end");
  Incumbent& incumbent = context_.incumbent;
  // A draft of many long paths costs much; the incumbent has as much again. Measured after 10 s:
  // without, 300 agents on warehouse-10-20-10-2-1 have a plan of 33,105 instead of 25,298.
  std::int64_t draft_effort = 0;
  for (const Path& path : draft_.paths)
    draft_effort += kPasses * static_cast<std::int64_t>(path.size());
  extra_effort_ = 2 * draft_effort;
  if (!improver_)
    improver_.emplace(context_.instance, context_.distances, context_.objective, incumbent.plan(),
                      context_.seed);
  else if (*incumbent.upper() < improver_->cost())
    improver_->restart_from(incumbent.plan());
  if (improver_->improve(*slice.effort + draft_effort, context_.limits))
    incumbent.offer(improver_->plan());
  improve_draft(*slice.effort);
  return sat::Outcome::working;
}

void PlanImprovement::improve_draft(std::int64_t effort) {
  const Plan draft = std::exchange(draft_, {});
  if (draft.paths.size() != context_.instance.num_agents()) return;
  const auto plan = repair_.repair(draft, context_.limits);
  if (!plan) return;
  if (rival_)
    rival_->restart_from(*plan);
  else
    rival_.emplace(context_.instance, context_.distances, context_.objective, *plan, context_.seed);
  static_cast<void>(rival_->improve(effort, context_.limits));
  if (rival_->cost() < *context_.incumbent.upper()) context_.incumbent.offer(rival_->plan());
}

bool PlanSearch::start() {
  static_cast<void>(first_plan_.advance({.effort = kFirstSlice}));
  start_effort_ += kFirstSlice;
  return !context_.incumbent.upper() && start_effort_ < kFirstEffort &&
         !context_.limits.exhausted_now();
}

void PlanSearch::advance(std::int64_t search_effort, const std::function<Plan()>& draft) {
  for (bool is_first = true; search_effort >= due_ && !context_.limits.exhausted();
       is_first = false) {
    const std::optional<Cost> before = context_.incumbent.upper();
    std::int64_t effort = kSlice;
    if (before) {
      // The search has one draft at a time.
      if (is_first) improvement_.set_draft(draft());
      static_cast<void>(improvement_.advance({.effort = kSlice}));
      effort += improvement_.extra_effort();
    } else {
      static_cast<void>(first_plan_.advance({.effort = kSlice}));
    }
    wait_ =
        context_.incumbent.upper() != before ? kShortestWait : std::min(kLongestWait, wait_ * 2);
    due_ += wait_ * effort;
  }
}

}  // namespace quadrille::discrete
