// SPDX-License-Identifier: MIT
#include "joint/joint_clock.hpp"

#include <algorithm>

#include "paths/bans.hpp"

namespace quadrille::continuous {
namespace {

/// What is left of the time from `from` on without these ticks, which increase.
std::vector<ClockSpan> without(const std::vector<TickInterval>& forbidden, Ticks from) {
  std::vector<ClockSpan> left;
  for (const TickInterval& ticks : forbidden) {
    if (ticks.begin > from) left.push_back({from, ticks.begin - 1});
    from = std::max(from, ticks.end);
  }
  if (from < kForever) left.push_back({from, kForever});
  return left;
}

}  // namespace

JointClock::JointClock(Scene& scene, const std::vector<AgentId>& agents) {
  const bool matters = std::any_of(agents.begin(), agents.end(), [&](AgentId i) {
    const Agent& agent = scene.instance().agent(i);
    return agent.release > 0 || agent.deadline || !scene.standing_bans(i).empty();
  });
  if (!matters) return;
  for (const AgentId i : agents) agents_.push_back(rules_of(scene, i));
}

JointClock::Rules JointClock::rules_of(Scene& scene, AgentId i) {
  const Instance& instance = scene.instance();
  const Agent& agent = instance.agent(i);
  const auto& distances = scene.task(i).distances;
  BanTable bans(instance.roadmap());
  bans.clear(scene.standing_bans(i));
  Rules rules;
  for (const VertexId v : IdRange<VertexId>(instance.roadmap().num_vertices())) {
    rules.stays.emplace_back();
    if (const auto place = bans.stays_of(v); place == BanTable::kFree)
      rules.stays.back().push_back(kAlways);
    else
      for (const BanTable::SafeStay& stay : bans.safe_stays(place))
        rules.stays.back().push_back({stay.from, stay.until});
    // Whoever arrives later is late, whatever it does then.
    rules.latest.push_back(agent.deadline ? *agent.deadline - distances[v] : kForever);
  }
  for (const EdgeId e : IdRange<EdgeId>(instance.roadmap().num_edges())) {
    const auto place = bans.starts_of(e);
    rules.starts.push_back(place == BanTable::kFree
                               ? Spans{{agent.release, kForever}}
                               : without(bans.forbidden_starts(place), agent.release));
  }
  return rules;
}

}  // namespace quadrille::continuous
