// SPDX-License-Identifier: MIT
#include "primal/time_windows.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "settle/shift_paths.hpp"

namespace quadrille::discrete {
namespace {

/// Timesteps of a window, and the effort for it by timestep and agent. Measured with 32, 64, 128
/// and 256, and 2, 5 and 20, after six to eight seconds: rooms with 550 agents 2,003, 1,700, 1,332
/// and 1,189 timesteps (of 2,907) with an effort of 5, and 2,390, 2,155 and 1,963 with 20; 1,127
/// with 256 and 2. In a maze with 500 2,478 to 2,591 with efforts of 2 and 5, 2,669 to 2,834
/// with 20. One seed of each, from plans of a version of Rush without kMovers.
constexpr Timestep kLength = 256;
constexpr std::int64_t kEffort = 2;
/// A pass that gains less than one part in so many of the cost is the last one.
constexpr Cost kLeastGain = 50;

}  // namespace

TimeWindows::TimeWindows(const Instance& instance, Plan plan, std::uint32_t seed)
    : instance_(instance),
      seed_(seed),
      plan_(std::move(plan)),
      cost_(plan_.cost(Objective::sum_of_costs)) {
  begin_pass();
}

void TimeWindows::begin_pass() {
  length_ = static_cast<Timestep>(plan_.cost(Objective::makespan));
  from_ = to_ = 0;
  is_over_ = length_ == 0;
  next_ = Plan();
  for (const AgentId i : instance_.agent_ids())
    next_.paths.push_back({instance_.agents()[i].start});
}

void TimeWindows::advance(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  while (!is_over_ && effort_ < enough && !limits.exhausted()) {
    if (window_ && left_ > 0 && !window_->is_ideal()) {
      const std::int64_t before = window_->effort();
      window_->improve(std::min(left_, enough - effort_), limits);
      left_ -= window_->effort() - before;
      effort_ += window_->effort() - before;
    } else if (window_) {
      end_window();
    } else if (from_ < length_) {
      if (!begin_window(limits)) return;
    } else {
      end_pass(limits);
    }
  }
}

/// False if a limit was met.
bool TimeWindows::begin_window(LimitMonitor& limits) {
  // Other boundaries than those of the pass before.
  const bool is_shifted = from_ == 0 && num_passes_ % 2 == 1;
  to_ = std::min(length_, from_ + (is_shifted ? kLength / 2 : kLength));
  std::vector<Agent> ends;
  Plan middle;
  for (const Path& path : plan_.paths) {
    ends.push_back({position(path, from_), position(path, to_)});
    Path part;
    for (Timestep t = from_; t <= to_; ++t) part.push_back(position(path, t));
    middle.paths.push_back(std::move(part));
  }
  trim(middle);
  const auto instance = Instance::make(instance_.shared_graph(), std::move(ends));
  QUADRILLE_REQUIRE(instance.has_value(), "a plan has all agents in vertices of their own");
  auto distances = GoalDistances::make(*instance, limits);
  if (distances == nullptr) return false;
  const auto num_agents = static_cast<std::int64_t>(instance_.num_agents());
  // A step of these searches takes a fraction of one of others.
  effort_ += num_agents * static_cast<std::int64_t>(instance_.graph().num_vertices()) / 8;
  window_.emplace(*instance, std::move(distances), Objective::sum_of_costs, middle,
                  seed_ + num_passes_);
  left_ = kEffort * num_agents * (to_ - from_);
  return true;
}

void TimeWindows::end_window() {
  const Plan& middle = window_->plan();
  const auto length = static_cast<Timestep>(middle.cost(Objective::makespan));
  for (const AgentId i : instance_.agent_ids())
    for (Timestep t = 1; t <= length; ++t) next_.paths[i].push_back(position(middle.paths[i], t));
  from_ = to_;
  window_.reset();
}

void TimeWindows::end_pass(LimitMonitor& limits) {
  trim(next_);
  std::optional<Plan> tight = tightened(instance_, next_, limits);
  if (!tight) {
    is_over_ = true;
    return;
  }
  const Cost cost = tight->cost(Objective::sum_of_costs), before = cost_;
  effort_ += cost / 4 + 1;
  if (cost < cost_) {
    plan_ = *std::move(tight);
    cost_ = cost;
  }
  ++num_passes_;
  begin_pass();
  is_over_ = is_over_ || kLeastGain * (before - cost_) < before;
}

}  // namespace quadrille::discrete
