// SPDX-License-Identifier: MIT
#include "session/history.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille::continuous {

Later later(const Path& path, Ticks time) {
  std::size_t k = 0;
  while (k + 1 < path.size() && path[k + 1].arrive <= time) ++k;
  Later later;
  later.is_first = k == 0;
  later.at = path[k].vertex;
  later.ends = k + 1 == path.size();
  later.moves = !later.ends && time > path[k].depart;
  Ticks departs = 0;
  if (later.moves) {
    later.to = path[k + 1].vertex;
    later.begun = time - path[k].depart;
  } else if (!later.ends) {
    departs = path[k].depart - time;
  }
  later.rest.push_back({later.at, 0, departs});
  for (++k; k < path.size(); ++k)
    later.rest.push_back({path[k].vertex, path[k].arrive - time, path[k].depart - time});
  return later;
}

}  // namespace quadrille::continuous
