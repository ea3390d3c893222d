// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "paths/bans.hpp"
#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// The least arrival of a path that obeys the bans, tick by tick: who is where when. Shares nothing
/// with the search in safe intervals. Requires an instance whose durations are small.
[[nodiscard]] inline std::optional<Ticks> least_arrival(const Instance& instance, AgentId agent,
                                                        const std::vector<Ban>& bans) {
  const Roadmap& roadmap = instance.roadmap();
  const ClassId c = instance.class_of(agent);
  const VertexId goal = instance.agent(agent).goal();
  // By then, no ban begins or ends any more, and there is time for any way.
  Ticks end = instance.agent(agent).release + 1;
  for (const Ban& ban : bans)
    for (const Ticks tick : {ban.when.begin, ban.when.end})
      if (tick < kForever) end = std::max(end, tick + 1);
  for (std::size_t e = 0; e < roadmap.num_edges(); ++e) end += instance.duration(c, EdgeId(e));

  const auto is_banned = [&](Ban::Kind kind, std::uint32_t place, const auto& test) {
    return std::any_of(bans.begin(), bans.end(), [&](const Ban& ban) {
      return ban.kind == kind && ban.place == place && test(ban);
    });
  };
  const auto may_be = [&](VertexId v, Ticks t) {  // at that moment
    return !is_banned(Ban::Kind::stay, v.value(),
                      [&](const Ban& ban) { return ban.when.begin < t && t < ban.when.end; });
  };
  const auto may_wait = [&](VertexId v, Ticks t) {  // from t to t + 1
    return !is_banned(Ban::Kind::stay, v.value(),
                      [&](const Ban& ban) { return ban.when.begin < t + 1 && t < ban.when.end; });
  };
  const auto may_rest = [&](Ticks t) {
    return instance.agent(agent).leaves ||
           !is_banned(Ban::Kind::stay, goal.value(),
                      [&](const Ban& ban) { return t < ban.when.end; });
  };
  std::vector<std::vector<bool>> is_at(
      roadmap.num_vertices(), std::vector<bool>(static_cast<std::size_t>(end.value()) + 1));
  const auto arrive = [&](VertexId v, Ticks t) {
    if (t <= end && may_be(v, t)) is_at[v.index()][static_cast<std::size_t>(t.value())] = true;
  };
  arrive(instance.agent(agent).start, 0);
  for (Ticks t = 0; t <= end; ++t) {
    // Who waits at the goal from t - 1 on has arrived then, and was found already if it may rest.
    if (is_at[goal.index()][static_cast<std::size_t>(t.value())] && may_rest(t))
      return t <= instance.agent(agent).deadline.value_or(t) ? std::optional(t) : std::nullopt;
    for (const VertexId v : IdRange<VertexId>(roadmap.num_vertices()))
      if (is_at[v.index()][static_cast<std::size_t>(t.value())] && roadmap.may_wait(v) &&
          may_wait(v, t))
        arrive(v, t + 1);
    if (t < instance.agent(agent).release) continue;  // no moves yet
    for (std::size_t e = 0; e < roadmap.num_edges(); ++e) {
      const Edge& edge = roadmap.edge(EdgeId(e));
      if (!is_at[edge.from.index()][static_cast<std::size_t>(t.value())] ||
          !edge.open_to.contains(instance.agent(agent).group))
        continue;
      if (is_banned(Ban::Kind::start, static_cast<std::uint32_t>(e),
                    [&](const Ban& ban) { return ban.when.begin <= t && t < ban.when.end; }))
        continue;
      arrive(edge.to, t + instance.duration(c, EdgeId(e)));
    }
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous::test
