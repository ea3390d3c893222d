// SPDX-License-Identifier: MIT
#include "primal/shortcuts.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace quadrille::discrete {
namespace {

/// Timesteps of jumps. Where the least one fails they are kept. Measured on plans of 9,249 and
/// 5,026 timesteps for 500 agents in a maze and 550 in rooms: jumps of less than 256 hardly ever
/// succeed, and those that visit more configurations than timesteps seldom do.
constexpr Timestep kMostReach = 2048, kLeastReach = 256;
/// A pass that shortens the plan by less than one part in kLeastGain is the last one.
constexpr Timestep kLeastGain = 50;
/// Configurations that a jump may visit, for each timestep that it is to replace.
constexpr std::int64_t kConfigurationsPerTimestep = 1;

}  // namespace

Shortcuts::Shortcuts(const Instance& instance, Plan plan, std::uint32_t seed)
    : instance_(instance), seed_(seed), plan_(std::move(plan)), reach_(kMostReach) {
  begin_pass();
}

void Shortcuts::begin_pass() {
  length_ = static_cast<Timestep>(plan_.cost(Objective::makespan));
  at_ = length_of_shorter_ = 0;
  shorter_ = Plan();
  for (const AgentId i : instance_.agent_ids())
    shorter_.paths.push_back({instance_.agents()[i].start});
  is_over_ = length_ < 2 * kLeastReach;
}

void Shortcuts::end_pass() {
  trim(shorter_);
  const Timestep gain = length_ - static_cast<Timestep>(shorter_.cost(Objective::makespan));
  const bool is_cheaper =
      shorter_.cost(Objective::sum_of_costs) < plan_.cost(Objective::sum_of_costs);
  if (is_cheaper) plan_ = std::move(shorter_);
  const bool gains = is_cheaper && gain >= length_ / kLeastGain;
  ++num_passes_;
  begin_pass();
  is_over_ = is_over_ || !gains;
}

/// A plan from the configuration at one timestep to that at another one, in fewer timesteps.
std::optional<Plan> Shortcuts::jump(Timestep from, Timestep to, LimitMonitor& limits) {
  std::vector<Agent> agents;
  for (const Path& path : plan_.paths) agents.push_back({position(path, from), position(path, to)});
  const auto instance = Instance::make(instance_.shared_graph(), std::move(agents));
  auto distances = GoalDistances::make(*instance, limits);
  if (distances == nullptr) return std::nullopt;
  const auto num_agents = static_cast<std::int64_t>(instance_.num_agents());
  // A step of these searches takes a fraction of one of others.
  effort_ += num_agents * static_cast<std::int64_t>(instance_.graph().num_vertices()) / 8;
  Lacam search(*instance, std::move(distances), seed_ + num_passes_, nullptr);
  search.advance(kConfigurationsPerTimestep * (to - from) * (num_agents + 1), limits);
  effort_ += search.effort();
  if (search.state() != Lacam::State::found) return std::nullopt;
  Plan plan = search.plan();
  if (plan.cost(Objective::makespan) >= to - from) return std::nullopt;
  return plan;
}

/// The timesteps from+1 .. to of a plan that is where this pass has come to at `from`.
void Shortcuts::append(const Plan& piece, Timestep from, Timestep to) {
  for (const AgentId i : instance_.agent_ids()) {
    Path& path = shorter_.paths[i];
    for (Timestep t = from + 1; t <= to; ++t) path.push_back(position(piece.paths[i], t));
  }
  length_of_shorter_ += to - from;
}

void Shortcuts::advance(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  while (!is_over_ && effort_ < enough && !limits.exhausted()) {
    if (at_ >= length_) {
      end_pass();
      continue;
    }
    // Other boundaries than those of the pass before.
    const Timestep reach =
        at_ == 0 && num_passes_ % 2 == 1 ? std::min(reach_, kLeastReach * 3 / 2) : reach_;
    const Timestep to = std::min(length_, at_ + reach);
    if (const auto piece = jump(at_, to, limits)) {
      append(*piece, 0, static_cast<Timestep>(piece->cost(Objective::makespan)));
      at_ = to;
      reach_ = std::min(kMostReach, 2 * reach_);
    } else if (reach_ > kLeastReach) {
      reach_ /= 2;
    } else if (!limits.exhausted()) {
      append(plan_, at_, to);
      at_ = to;
    }
  }
}

}  // namespace quadrille::discrete
