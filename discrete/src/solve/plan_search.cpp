// SPDX-License-Identifier: MIT
#include "solve/plan_search.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// Of a search for a first plan, and the least of improvement.
constexpr Effort kFirstSlice = Effort::microseconds(62'500),
                 kLeastSlice = Effort::microseconds(6'250);
/// Whoever makes plans in a thread of its own tells more than that took: others wait for it at the
/// end of each round, and it may take longer. First plans, measured as 1, 2 and 4 times, two
/// threads and 1,000 agents: warehouse-20-40-10-2-1 to a gap of 2 % 7.6, 5.6 and 5.7 s,
/// den520d 1.4, 1.6 and 2.3 s. Improvement counted once: nine agents, dpll-mdd
/// and two threads take three times as long.
constexpr std::int64_t kTimesFirst = 2, kTimesImproved = 4;
/// Improvement of a first plan is looked at when all paths could have been made so many times.
constexpr std::int64_t kFirstLook = 32;

/// Whatever it was made of came first.
constexpr std::string_view kImproved = "improvement";

/// Per cent; none where a plan has refuted the bound, which is one of the user's then. Requires an
/// incumbent.
double gap_of(const Incumbent& incumbent) {
  const Cost lower = incumbent.lower();
  return gap_percent(std::max(*incumbent.upper(), lower), lower);
}

/// Who makes only a part of the first plan makes plans beside another one, where it has nothing
/// better to do.
bool is_helper(const PlanSearchContext& context) {
  return context.part == PrimalSearch::Part::first_guide;
}

/// Two that improve a plan do not do so by the same steps.
PlanSearchContext for_improvement(PlanSearchContext context) {
  if (is_helper(context)) context.seed = ~context.seed;
  return context;
}

}  // namespace

sat::Outcome FirstPlan::advance(sat::Slice slice) {
  QUADRILLE_REQUIRE(slice.effort.has_value(), "the slice has an end");
  if (search_ &&
      search_->advance(steps_of_plans(*slice.effort), context_.limits) ==
          PrimalSearch::State::found &&
      (!told_ || search_->cost() < *told_)) {
    context_.incumbent.offer(search_->shared_plan(), search_->origin());
    told_ = search_->cost();
  }
  return sat::Outcome::working;
}

void PlanImprovement::offer_draft(const std::function<Plan()>& draft) {
  if (!repair_.wants_draft()) {
    repair_.let_pass();
    return;
  }
  const Plan paths = draft();
  if (paths.paths.size() != context_.instance.num_agents()) return;
  repair_.begin(paths);
  ++num_drafts_;
}

sat::Outcome PlanImprovement::advance(sat::Slice slice) {
  QUADRILLE_REQUIRE(slice.effort.has_value(), "the slice has an end");
  Incumbent& incumbent = context_.incumbent;
  effort_ = {};
  if (!improver_) {
    second_chance_.emplace(context_.instance, context_.priced_distances, context_.objective,
                           incumbent.shared_plan(), context_.seed, context_.settings);
    improver_.emplace(context_.instance, context_.priced_distances, context_.objective,
                      incumbent.plan(), context_.seed);
  } else if (*incumbent.upper() < improver_->cost()) {
    improver_->restart_from(incumbent.plan());
  }
  const Effort effort =
      is_at_first_draft() ? *slice.effort / context_.settings.plans_draft_share : *slice.effort;
  if (has_second_chance())
    take_second_chance(effort);
  else if (improve(*improver_, effort))
    incumbent.offer(improver_->plan(), kImproved);
  if (!is_at_first_draft() &&
      gap_of(incumbent) >= in_percent(context_.settings.plans_second_chance_gap))
    second_chance_->watch(improver_->effort(), *incumbent.upper(),
                          *incumbent.upper() - incumbent.lower());
  // The more drafts have resisted, the more of the time the incumbent gets.
  const bool is_turn =
      repair_.patience() == 1 || repair_.patience() * repair_.effort() <= improver_->effort();
  if (repair_.is_at_work() && is_turn) improve_draft(*slice.effort);
  return sat::Outcome::working;
}

/// What it takes may be more: neighbourhoods are not cut short.
bool PlanImprovement::improve(PlanImprover& improver, Effort effort) {
  const std::int64_t before = improver.effort();
  const bool is_better = improver.improve(steps_of_plans(effort), context_.limits);
  effort_ += effort_of_plans(improver.effort() - before);
  return is_better;
}

void PlanImprovement::take_second_chance(Effort effort) {
  Incumbent& incumbent = context_.incumbent;
  const std::int64_t before = second_chance_->effort();
  if (auto plan =
          second_chance_->advance(steps_of_plans(effort), context_.limits, *incumbent.upper()))
    incumbent.offer(*std::move(plan), kImproved);
  effort_ += effort_of_plans(second_chance_->effort() - before);
}

void PlanImprovement::improve_draft(Effort effort) {
  const std::int64_t before = repair_.effort();
  const bool is_plan = repair_.advance(steps_of_plans(effort), context_.limits);
  effort_ += effort_of_plans(repair_.effort() - before);
  if (!is_plan) return;
  if (rival_)
    rival_->restart_from(repair_.plan());
  else
    rival_.emplace(context_.instance, context_.priced_distances, context_.objective, repair_.plan(),
                   context_.seed);
  static_cast<void>(improve(*rival_, effort));
  const bool is_cheaper = rival_->cost() < *context_.incumbent.upper();
  repair_.report(is_cheaper);
  if (is_cheaper) context_.incumbent.offer(rival_->plan(), kImproved);
}

PlanSearch::PlanSearch(const PlanSearchContext& context)
    : context_(context),
      first_plan_(context),
      improvement_(for_improvement(context)),
      gain_(context.settings) {
  std::int64_t steps = 0;
  for (const AgentId i : context.instance.agent_ids())
    steps += (*context.distances)(i, context.instance.agents()[i].start);
  long_slice_ = std::max(kLeastSlice, effort_of_plans(steps));
  next_look_ = kFirstLook * effort_of_plans(steps);
}

bool PlanSearch::start() {
  if (is_first_plan_due())
    static_cast<void>(first_plan_.advance({.effort = kFirstSlice}));
  else if (is_improvement_due_)
    improve_first_plan();
  return (is_first_plan_due() || is_improvement_due_) && !context_.incumbent.are_closed() &&
         !context_.limits.exhausted_now();
}

bool PlanSearch::is_first_plan_due() const {
  return !first_plan_.is_over() &&
         (first_plan_.effort() < most_first_effort() || first_plan_.is_worth_waiting_for());
}

/// One slice.
void PlanSearch::improve_first_plan() {
  const Settings& settings = context_.settings;
  const Effort most = Effort::microseconds(settings.plans_first_improvement);
  const Incumbent& incumbent = context_.incumbent;
  const auto is_dear = [&] {
    // It begins with all paths at once.
    return context_.objective == Objective::sum_of_costs && incumbent.upper() &&
           effort_of_plans(*incumbent.upper()) <= most &&
           gap_of(incumbent) >= in_percent(settings.plans_large_gap);
  };
  is_improvement_due_ = is_dear();
  if (!is_improvement_due_) return;
  const Cost before = *incumbent.upper();
  static_cast<void>(improvement_.advance({.effort = long_slice_}));
  const Cost gain = before - *incumbent.upper();
  gain_.count_plans(improvement_.effort(), gain, gap_of(incumbent));
  effort_ += improvement_.effort();
  gain_since_look_ += gain;
  is_improvement_due_ = is_dear() && effort_ < most;
  if (effort_ < next_look_) return;
  const Cost gap = *incumbent.upper() - incumbent.lower();
  if (settings.plans_little * gain_since_look_ < gap) is_improvement_due_ = false;
  next_look_ = effort_ + effort_ / settings.plans_look_again;
  gain_since_look_ = 0;
}

void PlanSearch::advance(Effort search_effort, const std::function<Plan()>& draft,
                         const std::function<void()>& after_slice) {
  count_search(search_effort);
  // As long as one path of everybody, so that there are several neighbourhoods in it; short where
  // turns would be rare.
  const Effort slice = credit_ >= long_slice_ ? long_slice_ : kLeastSlice;
  if (credit_ < slice) return;
  const Incumbent& incumbent = context_.incumbent;
  const double small_gap = in_percent(context_.settings.plans_small_gap);
  const bool has_nothing_to_do = incumbent.upper()
                                     ? is_helper(context_) && gap_of(incumbent) < small_gap
                                     : first_plan_.is_over();
  if (has_nothing_to_do) {
    credit_ = {};
    return;
  }
  const Effort credit = credit_;
  const std::optional<Cost> first = incumbent.upper();
  Cost gain = 0;
  if (first && draft) improvement_.offer_draft(draft);
  while (credit_ >= slice && !incumbent.are_closed() && !context_.limits.exhausted()) {
    Effort spent;
    if (const std::optional<Cost> before = incumbent.upper()) {
      static_cast<void>(improvement_.advance({.effort = slice}));
      gain += *before - *incumbent.upper();
      spent = std::max(slice, improvement_.effort());
      credit_ -= spent;
      // What is left was for the draft.
      if (is_hopeful_ && !improvement_.is_hopeful()) credit_ = std::min(credit_, Effort());
    } else {
      const Effort before_it = first_plan_.effort();
      static_cast<void>(first_plan_.advance({.effort = slice}));
      spent = std::max(slice, first_plan_.effort() - before_it);
      credit_ -= spent;
    }
    effort_ += spent;
    if (after_slice) after_slice();
  }
  seen_upper_ = incumbent.upper();
  if (first) gain_.count_plans(credit - credit_, gain, gap_of(incumbent));
}

void PlanSearch::hear(Cost less) {
  if (seen_upper_) *seen_upper_ -= less;
}

void PlanSearch::begin() {
  while (first_plan_.is_at_guides() && !context_.limits.exhausted_now())
    static_cast<void>(first_plan_.advance({.effort = kFirstSlice}));
}

Effort PlanSearch::work(const std::function<Plan()>& draft) {
  const Effort before = first_plan_.effort();
  const bool is_due = !context_.incumbent.upper() || before < most_first_effort() ||
                      first_plan_.is_worth_waiting_for();
  if (!first_plan_.is_over() && is_due) {
    static_cast<void>(first_plan_.advance({.effort = kFirstSlice}));
    return kTimesFirst * std::max(kFirstSlice, first_plan_.effort() - before);
  }
  if (!context_.incumbent.upper())
    return kTimesImproved * kFirstSlice;  // until another search finds a plan
  improvement_.offer_draft(draft);
  static_cast<void>(improvement_.advance({.effort = long_slice_}));
  return kTimesImproved * std::max(long_slice_, improvement_.effort());
}

void PlanSearch::count_search(Effort search_effort) {
  const Incumbent& incumbent = context_.incumbent;
  const Effort effort = search_effort - seen_effort_;
  Cost gain = incumbent.lower() - seen_lower_;
  if (seen_upper_) gain += *seen_upper_ - *incumbent.upper();
  gain_.count_search(effort, gain);
  is_hopeful_ = improvement_.is_hopeful() &&
                search_effort >= Effort::microseconds(context_.settings.plans_draft_patience) &&
                gap_of(incumbent) >= in_percent(context_.settings.plans_draft_gap);
  credit_ += is_hopeful_ ? gain_.most_due(effort) : gain_.due(effort);
  seen_effort_ = search_effort;
  seen_lower_ = incumbent.lower();
  seen_upper_ = incumbent.upper();
}

}  // namespace quadrille::discrete
