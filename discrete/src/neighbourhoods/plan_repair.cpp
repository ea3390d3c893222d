// SPDX-License-Identifier: MIT
#include "neighbourhoods/plan_repair.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

// A path is given up when it takes more effort than this per timestep of the old one, plus
// something for short paths; the limit grows with the failures.
constexpr std::int64_t kEffortPerTimestep = 100;
constexpr std::int64_t kLeastEffort = 1000;
constexpr std::int64_t kFailuresPerEffort = 8;
// More failures than this count as this many: slices remain slices, and memory bounded.
constexpr std::int64_t kMostFailures = 64;
// Agents taken out together: powers of two. One or two at first, which keeps most paths.
constexpr std::uint64_t kFirstSizes = 2, kMostSizes = 4;
// How much later than alone an agent may arrive: powers of two as well. The smaller, the cheaper
// the plan, and the sooner the planner knows that there is nothing better.
constexpr Timestep kLeastSlack = 2;
constexpr std::uint64_t kFirstSlacks = 3, kMostSlacks = 10;
// Failures after which both ranges are wider by one.
constexpr std::int64_t kPatience = 4;

}  // namespace

PlanRepair::PlanRepair(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                       std::uint32_t seed)
    : instance_(instance),
      distances_(std::move(distances)),
      random_(seed),
      reservations_(instance.graph().num_vertices()),
      planner_(instance_, *distances_, random_),
      meetings_(instance.num_agents(), 0),
      place_(instance.num_agents(), 0),
      gathering_(instance) {}

std::optional<Plan> PlanRepair::repair(const Plan& draft, std::int64_t effort,
                                       LimitMonitor& limits) {
  restart_from(draft);
  if (!advance(effort, limits)) return std::nullopt;
  return plan_;
}

void PlanRepair::restart_from(const Plan& draft) {
  QUADRILLE_REQUIRE(draft.paths.size() == instance_.num_agents(), "one path per agent");
  reservations_.clear();
  std::fill(meetings_.begin(), meetings_.end(), 0);
  num_meetings_ = num_failures_ = 0;
  colliding_.clear();
  plan_ = draft;
  trim(plan_);
  for (const AgentId agent : instance_.agent_ids()) {
    effort_ += static_cast<std::int64_t>(plan_.paths[agent].size()) / 4 + 1;
    reserve(agent);
  }
}

bool PlanRepair::advance(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  while (num_meetings_ > 0 && effort_ < enough && !limits.exhausted()) step(limits);
  return num_meetings_ == 0;
}

void PlanRepair::step(LimitMonitor& limits) {
  const auto impatience = static_cast<std::uint64_t>(num_failures_ / kPatience);
  choose(std::size_t{1} << random_.below(std::min(kMostSizes, kFirstSizes + impatience)));
  const std::int64_t before = num_meetings_;
  old_paths_.clear();
  for (const AgentId agent : chosen_) {
    release(agent);
    old_paths_.push_back(std::move(plan_.paths[agent]));
    effort_ += static_cast<std::int64_t>(old_paths_.back().size()) / 4 + 1;
  }
  const Timestep slack = kLeastSlack
                         << random_.below(std::min(kMostSlacks, kFirstSlacks + impatience));
  const std::int64_t effort_before = planner_.effort();
  std::size_t num_new = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const AgentId agent = chosen_[k];
    const Timestep least = (*distances_)(agent, instance_.agents()[agent].start);
    const auto old_arrival = static_cast<Timestep>(old_paths_[k].size()) - 1;
    const Timestep latest = std::max(least + slack, old_arrival);
    auto found = planner_.find(agent, reservations_, latest, before - num_meetings_,
                               allowed(old_paths_[k]), limits);
    if (!found) break;
    plan_.paths[agent] = std::move(found->path);
    reserve(agent);
    ++num_new;
  }
  effort_ += planner_.effort() - effort_before;
  if (num_new < chosen_.size()) put_back(num_new);
  // Where one meeting was hard to end the next one will be, too.
  num_failures_ =
      num_meetings_ < before ? num_failures_ * 3 / 4 : std::min(kMostFailures, num_failures_ + 1);
}

/// The effort that a new path may take.
std::int64_t PlanRepair::allowed(const Path& old_path) const {
  const auto length = static_cast<std::int64_t>(old_path.size());
  return (kEffortPerTimestep * length + kLeastEffort) * (1 + num_failures_ / kFailuresPerEffort);
}

void PlanRepair::put_back(std::size_t num_new) {
  for (std::size_t k = 0; k < num_new; ++k) release(chosen_[k]);
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    plan_.paths[chosen_[k]] = std::move(old_paths_[k]);
    reserve(chosen_[k]);
  }
}

/// An agent that meets others, those it meets, those these meet, and so on; and when that is not
/// enough, those who pass the vertices near its path.
void PlanRepair::choose(std::size_t size) {
  const AgentId seed = colliding_[static_cast<std::size_t>(random_.below(colliding_.size()))];
  gathering_.take(seed);
  for (std::size_t head = 0; head < gathering_.size() && gathering_.size() < size; ++head) {
    met_.clear();
    reservations_.for_each_meeting(gathering_[head], plan_.paths[gathering_[head]],
                                   [this](AgentId other) { met_.push_back(other); });
    random_.shuffle_front(met_, met_.size());
    for (const AgentId other : met_)
      if (gathering_.size() < size) gathering_.take(other);
  }
  if (gathering_.size() < size) {
    const Path& path = plan_.paths[seed];
    const VertexId centre = path[static_cast<std::size_t>(random_.below(path.size()))];
    const std::size_t steps = gathering_.take_around(centre, size, reservations_, random_);
    effort_ += static_cast<std::int64_t>(steps) / 4;
  }
  chosen_ = gathering_.release();
  random_.shuffle_front(chosen_, chosen_.size());
}

void PlanRepair::reserve(AgentId agent) {
  const Path& path = plan_.paths[agent];
  reservations_.for_each_meeting(agent, path, [&](AgentId other) {
    change_meetings(agent, 1);
    change_meetings(other, 1);
    ++num_meetings_;
  });
  reservations_.add(agent, path);
}

void PlanRepair::release(AgentId agent) {
  const Path& path = plan_.paths[agent];
  reservations_.remove(agent, path);
  reservations_.for_each_meeting(agent, path, [&](AgentId other) {
    change_meetings(agent, -1);
    change_meetings(other, -1);
    --num_meetings_;
  });
}

void PlanRepair::change_meetings(AgentId agent, std::int64_t change) {
  std::int64_t& count = meetings_[agent];
  if (count == 0) {
    place_[agent] = colliding_.size();
    colliding_.push_back(agent);
  }
  count += change;
  if (count > 0) return;
  const AgentId last = colliding_.back();
  colliding_[place_[agent]] = last;
  place_[last] = place_[agent];
  colliding_.pop_back();
}

}  // namespace quadrille::discrete
