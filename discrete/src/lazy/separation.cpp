// SPDX-License-Identifier: MIT
#include "lazy/separation.hpp"

#include <algorithm>

namespace quadrille::discrete {

const std::vector<Encounter>& Separation::collisions() {
  collisions_.clear();
  for (const Encounter& e : paths_.collisions())
    if (takes_part(trail_, e.first) && takes_part(trail_, e.second)) collisions_.push_back(e);
  return collisions_;
}

bool Separation::bypass(AgentId i) {
  const Path* quieter = search_.find_quieter(i, trail_.active(i), cap_of(trail_, i));
  if (quieter == nullptr) return false;
  trail_.replace_path(i, *quieter);
  return true;
}

bool Separation::bypass_all() {
  std::vector<AgentId> colliding;
  for (const Encounter& e : collisions()) {
    colliding.push_back(e.first);
    colliding.push_back(e.second);
  }
  std::sort(colliding.begin(), colliding.end());
  colliding.erase(std::unique(colliding.begin(), colliding.end()), colliding.end());
  bool any = false;
  for (const AgentId i : colliding) any = (!limits_.exhausted() && bypass(i)) || any;
  return any;
}

}  // namespace quadrille::discrete
