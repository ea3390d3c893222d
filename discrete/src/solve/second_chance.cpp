// SPDX-License-Identifier: MIT
#include "solve/second_chance.hpp"

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// The hopes of a plan are looked at after one such part of its effort, then whenever that has
/// doubled.
constexpr std::int64_t kFirstPart = 16;

}  // namespace

// The incumbent is looked at whenever its effort has grown by some part. If that gained little of
// the gap, the first plan is improved anew, with more effort than all before; then the incumbent
// has time to get as much before the next look.
void SecondChance::watch(std::int64_t effort, Cost cost, Cost gap) {
  if (is_at_work() || effort + past_effort_ < next_look_) return;
  const bool is_dead_end = watched_cost_ && settings_.plans_little * (*watched_cost_ - cost) < gap;
  watched_effort_ = effort;
  watched_cost_ = cost;
  next_look_ += next_look_ / settings_.plans_look_again;
  if (!is_dead_end) return;
  ++seed_;
  improver_.emplace(instance_, distances_, objective_, *first_, seed_);
  allowed_ = settings_.plans_second_chance_times * (effort + past_effort_);
  seen_effort_ = allowed_ / kFirstPart;
  seen_cost_ = improver_->cost();
}

std::optional<Plan> SecondChance::advance(std::int64_t effort, LimitMonitor& limits, Cost cost) {
  QUADRILLE_REQUIRE(is_at_work(), "a plan is at work");
  const bool is_cheaper = improver_->improve(effort, limits) && improver_->cost() < cost;
  std::optional<Plan> plan;
  if (is_cheaper) plan = improver_->plan();
  if (improver_->effort() >= allowed_ || improver_->is_ideal() || is_hopeless(cost)) {
    past_effort_ += improver_->effort();
    improver_.reset();
    watched_cost_ = is_cheaper ? plan->cost(objective_) : cost;
    next_look_ = watched_effort_ + past_effort_ + allowed_;
  }
  return plan;
}

/// A plan gains less and less: it cannot do better than go on as it did since the last look.
bool SecondChance::is_hopeless(Cost cost) {
  const std::int64_t effort = improver_->effort();
  if (effort < 2 * seen_effort_) return false;
  const Cost gain = seen_cost_ - improver_->cost();
  const auto times =
      static_cast<double>(allowed_ - effort) / static_cast<double>(effort - seen_effort_);
  seen_effort_ = effort;
  seen_cost_ = improver_->cost();
  return static_cast<double>(gain) * times < static_cast<double>(seen_cost_ - cost);
}

}  // namespace quadrille::discrete
