// SPDX-License-Identifier: MIT
#include "quadrille/continuous/duration_error.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/areas.hpp"

namespace quadrille::continuous {

std::optional<DurationError> largest_duration_error(const Instance& instance) {
  const Roadmap& roadmap = instance.roadmap();
  std::vector<bool> seen(instance.num_classes(), false);
  std::optional<DurationError> worst;
  for (const AgentId i : instance.agent_ids()) {
    const ClassId c = instance.class_of(i);
    if (seen[c.index()]) continue;
    seen[c.index()] = true;
    for (std::size_t e = 0; e < roadmap.num_edges(); ++e) {
      const Edge& edge = roadmap.edge(EdgeId(e));
      if (edge.duration || !instance.may_use(c, EdgeId(e))) continue;
      const Speed own = instance.agent(i).speed;
      const double speed =
          static_cast<double>(std::min(own, edge.speed_limit.value_or(own)).value()) /
          static_cast<double>(kUnitSpeed.value());
      const auto squared = squared_distance(roadmap.position(edge.from), roadmap.position(edge.to));
      const double exact =
          static_cast<double>(std::sqrt(static_cast<long double>(squared))) / speed;
      const Ticks planned = instance.duration(c, EdgeId(e));
      const double relative = std::abs(static_cast<double>(planned.value()) - exact) / exact;
      if (!worst || relative > worst->relative)
        worst = DurationError{EdgeId(e), i, planned, exact, relative};
    }
  }
  return worst;
}

}  // namespace quadrille::continuous
