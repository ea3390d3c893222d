// SPDX-License-Identifier: MIT
#include "primal/draft_repair.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

// What a draft may cost for each timestep of its paths, and at least. Measured: 40 for 1,000 agents
// on den520d, 150 on warehouse-20-40-10-2-1.
constexpr std::int64_t kEffortPerTimestep = 100, kLeastEffort = 20'000;
constexpr std::int64_t kMostPatience = 64;

}  // namespace

void DraftRepair::begin(const Plan& draft) {
  QUADRILLE_REQUIRE(wants_draft(), "a draft is wanted");
  std::int64_t length = 0;
  for (const Path& path : draft.paths) length += static_cast<std::int64_t>(path.size());
  repair_.restart_from(draft);
  dropped_at_ = repair_.effort() + patience_ * (kEffortPerTimestep * length + kLeastEffort);
  is_at_work_ = true;
}

bool DraftRepair::advance(std::int64_t effort, LimitMonitor& limits) {
  QUADRILLE_REQUIRE(is_at_work_, "there is a draft");
  const bool is_plan = repair_.advance(effort, limits);
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
