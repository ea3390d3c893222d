// SPDX-License-Identifier: MIT
#include "theory/known_path.hpp"

#include <utility>

namespace quadrille::continuous {

KnownPathRef known_path(const Instance& instance, AgentId agent, TimedPath path,
                        std::uint64_t version) {
  auto known = std::make_shared<KnownPath>();
  known->uses.assign(instance, agent, path);
  list_steps(instance, agent, path, known->steps);
  known->path = std::move(path);
  known->version = version;
  return known;
}

}  // namespace quadrille::continuous
