// SPDX-License-Identifier: MIT
#include "theory/path_cache.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::continuous {

KnownPathRef PathCache::remember(const Instance& instance, AgentId agent, TimedPath path,
                                 std::uint64_t& last_version) {
  auto at = std::find_if(paths_.begin(), paths_.end(),
                         [&](const KnownPathRef& known) { return known->path == path; });
  if (at == paths_.end()) {
    auto fresh = std::make_shared<KnownPath>();
    fresh->uses.assign(instance, agent, path);
    list_steps(instance, agent, path, fresh->steps);
    fresh->path = std::move(path);
    fresh->version = ++last_version;
    if (paths_.size() == kCapacity) paths_.pop_back();
    at = paths_.insert(paths_.end(), std::move(fresh));
  }
  std::rotate(paths_.begin(), at, at + 1);
  return paths_.front();
}

}  // namespace quadrille::continuous
