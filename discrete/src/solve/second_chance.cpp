// SPDX-License-Identifier: MIT
#include "solve/second_chance.hpp"

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

/// The incumbent is looked at whenever its effort has grown by one part in kLookAgain. If that
/// gained less than one part in kLittle of the gap, the first plan is improved anew, with kTimes
/// the effort of all before; then the incumbent has time to get as much before the next look.
/// Measured on maze-32-32-4 with 100 agents and seeds 0 to 2, after 10 s:
/// 5051 to 5054; with 1 instead of kTimes 5065 to 5095, with 3 5054 to 5116. With 8 instead of
/// kLittle others come too soon: random-32-32-20 with 400 agents costs 15,032 instead of 14,426.
constexpr std::int64_t kLookAgain = 4, kLittle = 64, kTimes = 2;
/// The hopes of a plan are looked at after one such part of its effort, then whenever that has
/// doubled.
constexpr std::int64_t kFirstPart = 16;

}  // namespace

void SecondChance::watch(std::int64_t effort, Cost cost, Cost gap) {
  if (is_at_work() || effort + past_effort_ < next_look_) return;
  const bool is_dead_end = watched_cost_ && kLittle * (*watched_cost_ - cost) < gap;
  watched_effort_ = effort;
  watched_cost_ = cost;
  next_look_ += next_look_ / kLookAgain;
  if (!is_dead_end) return;
  ++seed_;
  improver_.emplace(instance_, distances_, objective_, first_, seed_);
  allowed_ = kTimes * (effort + past_effort_);
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
