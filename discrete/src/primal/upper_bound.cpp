// SPDX-License-Identifier: MIT
#include "primal/upper_bound.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::discrete {
namespace {

constexpr std::int64_t kFirstEffort = 20'000'000, kFirstSlice = 200'000, kSlice = 20'000;
constexpr std::int64_t kPasses = 5;  // over each path of a draft: copied, reserved, taken out again
constexpr std::int64_t kLargestShare = 8, kSmallestShare = 64;  // one in so many

}  // namespace

UpperBound::UpperBound(const Instance& instance, Objective objective,
                       std::shared_ptr<const GoalDistances> distances, std::uint32_t seed)
    : instance_(instance),
      objective_(objective),
      distances_(std::move(distances)),
      seed_(seed),
      first_(instance, distances_, seed),
      repair_(instance, distances_, seed),
      share_(kLargestShare),
      due_(kLargestShare * kSlice) {}

bool UpperBound::start(LimitMonitor& limits) {
  static_cast<void>(first_.advance(kFirstSlice, limits));
  start_effort_ += kFirstSlice;
  take_first_plan();
  return !improver_ && start_effort_ < kFirstEffort && !limits.exhausted_now();
}

void UpperBound::take_first_plan() {
  if (first_.state() == PrimalSearch::State::found)
    improver_.emplace(instance_, distances_, objective_, first_.plan(), seed_);
}

std::optional<Cost> UpperBound::cost() const {
  if (!improver_) return std::nullopt;
  return improver_->cost();
}

bool UpperBound::advance(std::int64_t search_effort, const std::function<Plan()>& draft,
                         LimitMonitor& limits) {
  bool is_cheaper = false;
  for (bool is_first = true; search_effort >= due_ && !limits.exhausted(); is_first = false) {
    extra_effort_ = 0;
    // The search has one draft at a time.
    const bool gains = work(is_first ? draft() : Plan(), limits);
    is_cheaper = is_cheaper || gains;
    share_ = gains ? kLargestShare : std::min(kSmallestShare, share_ * 2);
    due_ += share_ * (kSlice + extra_effort_);
  }
  return is_cheaper;
}

bool UpperBound::work(const Plan& draft, LimitMonitor& limits) {
  if (improver_) {
    const Cost before = improver_->cost();
    static_cast<void>(improver_->improve(kSlice, limits));
    try_draft(draft, limits);
    return improver_->cost() < before;
  }
  static_cast<void>(first_.advance(kSlice, limits));
  take_first_plan();
  return improver_.has_value();
}

void UpperBound::try_draft(const Plan& draft, LimitMonitor& limits) {
  if (draft.paths.size() != instance_.num_agents()) return;
  for (const Path& path : draft.paths)
    extra_effort_ += kPasses * static_cast<std::int64_t>(path.size());
  const auto plan = repair_.repair(draft, limits);
  if (!plan) return;
  if (rival_)
    rival_->restart_from(*plan);
  else
    rival_.emplace(instance_, distances_, objective_, *plan, seed_);
  static_cast<void>(rival_->improve(kSlice, limits));
  if (rival_->cost() < improver_->cost()) improver_->restart_from(rival_->plan());
}

void UpperBound::take(const Plan& plan) {
  if (!improver_)
    improver_.emplace(instance_, distances_, objective_, plan, seed_);
  else if (plan.cost(objective_) < improver_->cost())
    improver_->restart_from(plan);
}

}  // namespace quadrille::discrete
