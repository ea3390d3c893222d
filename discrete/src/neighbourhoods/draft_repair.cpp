// SPDX-License-Identifier: MIT
#include "neighbourhoods/draft_repair.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

// What it may take to halve the meetings, for each timestep of the paths, and at least. Where
// drafts become plans, meetings halve again and again in nearly the same time. Measured: 5 to 17 on
// warehouse-20-40-10-2-1 with 1,000 agents and on random-32-32-20 with 300, above 35 with 400,
// whose drafts never do. One limit of 100 for a whole draft, as before, dropped some with two
// meetings left, and those of random-32-32-20 with 400 agents late: a fifth of all effort was for
// them.
constexpr std::int64_t kEffortPerTimestep = 20, kLeastEffort = 20'000;
constexpr std::int64_t kMostPatience = 64;

}  // namespace

void DraftRepair::begin(const Plan& draft) {
  QUADRILLE_REQUIRE(wants_draft(), "a draft is wanted");
  std::int64_t length = 0;
  for (const Path& path : draft.paths) length += static_cast<std::int64_t>(path.size());
  repair_.restart_from(draft);
  effort_per_halving_ = patience_ * (kEffortPerTimestep * length + kLeastEffort);
  begin_halving();
  is_at_work_ = true;
}

void DraftRepair::begin_halving() {
  half_ = repair_.num_meetings() / 2;
  dropped_at_ = repair_.effort() + effort_per_halving_;
}

bool DraftRepair::advance(std::int64_t effort, LimitMonitor& limits) {
  QUADRILLE_REQUIRE(is_at_work_, "there is a draft");
  const bool is_plan = repair_.advance(effort, limits);
  if (repair_.num_meetings() <= half_) begin_halving();
  if (is_plan) {
    is_at_work_ = false;
    patience_ = std::max<std::int64_t>(1, patience_ / 2);
  } else if (repair_.effort() >= dropped_at_) {
    is_at_work_ = false;
    patience_ = std::min(kMostPatience, patience_ * 2);
    report(false);
  }
  return is_plan;
}

void DraftRepair::report(bool was_useful) {
  pause_ = was_useful ? 0 : std::min(kLongestPause, 2 * pause_ + 1);
  num_to_skip_ = pause_;
}

}  // namespace quadrille::discrete
