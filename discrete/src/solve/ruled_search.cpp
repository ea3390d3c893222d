// SPDX-License-Identifier: MIT
#include "solve/ruled_search.hpp"

#include <algorithm>

#include "solve/plan_search.hpp"

namespace quadrille::discrete {
namespace {

/// How long a first plan is looked for before the search, in how many attempts, in which slices,
/// and the share of the search's effort that plans get beside it.
constexpr Effort kMostFirst = Effort::microseconds(1'000'000), kSlice = Effort::microseconds(6'250);
constexpr std::int64_t kMostAttempts = 32, kShare = 8;
/// What so many orders of agents have not found, others do not find either.
constexpr std::int64_t kLastAttempt = 4096;

}  // namespace

bool RuledSearch::is_first_plan_due() const {
  return !incumbent_.upper() && plans_.effort() < steps_of_plans(kMostFirst) &&
         plans_.num_attempts() < kMostAttempts;
}

Effort RuledSearch::work() {
  const std::int64_t before = plans_.effort(), steps = steps_of_plans(kSlice);
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

void RuledSearch::advance(Effort search_effort, const std::function<void()>& after_slice) {
  credit_ += (search_effort - seen_effort_) / kShare;
  seen_effort_ = search_effort;
  for (; credit_ >= kSlice && !incumbent_.are_closed(); after_slice()) credit_ -= work();
}

}  // namespace quadrille::discrete
