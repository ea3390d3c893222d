// SPDX-License-Identifier: MIT
#include "solve/plan_search.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// Of a search for a first plan that nothing else runs beside, and of its slices.
constexpr std::int64_t kFirstEffort = 20'000'000, kFirstSlice = 200'000;
constexpr std::int64_t kLeastSlice = 20'000;
constexpr std::int64_t kLongestDraftWait = 64;
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
  draft_was_good_ = false;
  if (draft.paths.size() != context_.instance.num_agents()) return;
  const auto plan = repair_.repair(draft, effort, context_.limits);
  if (!plan) return;
  if (rival_)
    rival_->restart_from(*plan);
  else
    rival_.emplace(context_.instance, context_.distances, context_.objective, *plan, context_.seed);
  static_cast<void>(rival_->improve(effort, context_.limits));
  draft_was_good_ = rival_->cost() < *context_.incumbent.upper();
  if (draft_was_good_) context_.incumbent.offer(rival_->plan());
}

PlanSearch::PlanSearch(const PlanSearchContext& context)
    : context_(context), first_plan_(context), improvement_(context), slice_(kLeastSlice) {
  std::int64_t steps = 0;
  for (const AgentId i : context.instance.agents())
    steps += (*context.distances)(i, context.instance.tasks()[i].start);
  slice_ = std::max(slice_, steps);
  effort_to_draft_ = slice_;
}

bool PlanSearch::start() {
  static_cast<void>(first_plan_.advance({.effort = kFirstSlice}));
  start_effort_ += kFirstSlice;
  return !context_.incumbent.upper() && start_effort_ < kFirstEffort &&
         !context_.limits.exhausted_now();
}

void PlanSearch::advance(std::int64_t search_effort, const std::function<Plan()>& draft) {
  count_search(search_effort);
  if (credit_ < slice_) return;
  const Incumbent& incumbent = context_.incumbent;
  const std::int64_t credit = credit_;
  const std::optional<Cost> before = incumbent.upper();
  bool is_draft_fresh = true;  // The search has one draft at a time.
  while (credit_ >= slice_ && !incumbent.are_closed() && !context_.limits.exhausted()) {
    if (!incumbent.upper()) {
      static_cast<void>(first_plan_.advance({.effort = slice_}));
      credit_ -= slice_;
      continue;
    }
    const bool with_draft = is_draft_fresh && effort_to_draft_ <= 0;
    if (with_draft) improvement_.set_draft(draft());
    is_draft_fresh = is_draft_fresh && !with_draft;
    static_cast<void>(improvement_.advance({.effort = slice_}));
    const std::int64_t extra = improvement_.extra_effort();
    credit_ -= slice_ + extra;
    effort_to_draft_ -= slice_;
    if (!with_draft) continue;
    // Drafts cost more than slices: other improvement has as much, and the more the longer drafts
    // have been of no use.
    draft_wait_ = improvement_.draft_was_good() ? 1 : std::min(2 * draft_wait_, kLongestDraftWait);
    effort_to_draft_ = draft_wait_ * extra;
  }
  seen_upper_ = incumbent.upper();
  if (before)
    gain_.count_plans(credit - credit_, *before - *seen_upper_,
                      gap_percent(*seen_upper_, incumbent.lower()));
}

void PlanSearch::count_search(std::int64_t search_effort) {
  const Incumbent& incumbent = context_.incumbent;
  const std::int64_t effort = search_effort - seen_effort_;
  Cost gain = incumbent.lower() - seen_lower_;
  if (seen_upper_) gain += *seen_upper_ - *incumbent.upper();
  gain_.count_search(effort, gain);
  credit_ += gain_.due(effort);
  seen_effort_ = search_effort;
  seen_lower_ = incumbent.lower();
  seen_upper_ = incumbent.upper();
}

}  // namespace quadrille::discrete
