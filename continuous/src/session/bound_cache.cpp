// SPDX-License-Identifier: MIT
#include "session/bound_cache.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille::continuous {

// Edges may be closed that it used.
bool AnswerDomain::adopt(Path& path, const Instance& instance, AgentId agent) {
  // The place of one that is under way may have another number now.
  path.front().vertex = instance.agent(agent).start;
  const ClassId c = instance.class_of(agent);
  for (std::size_t k = 1; k < path.size(); ++k) {
    const auto out = instance.out_edges(c, path[k - 1].vertex);
    const bool fits = std::any_of(out.begin(), out.end(), [&](EdgeId e) {
      return instance.roadmap().to(e) == path[k].vertex &&
             instance.duration(c, e) == path[k].arrive - path[k - 1].depart;
    });
    if (!fits) return false;
  }
  return true;
}

}  // namespace quadrille::continuous
