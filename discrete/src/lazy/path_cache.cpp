// SPDX-License-Identifier: MIT
#include "lazy/path_cache.hpp"

#include <algorithm>

namespace quadrille::discrete {

void PathCache::add(AgentId agent, const Path& path) {
  Ring& ring = paths_[agent];
  if (capacity_ == 0 || std::find(ring.paths.begin(), ring.paths.end(), path) != ring.paths.end())
    return;
  if (ring.paths.size() < capacity_) {
    ring.paths.push_back(path);
    return;
  }
  ring.paths[ring.oldest] = path;
  ring.oldest = (ring.oldest + 1) % capacity_;
}

}  // namespace quadrille::discrete
