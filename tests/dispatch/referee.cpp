// SPDX-License-Identifier: MIT
#include "dispatch/referee.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::dispatch::test {

void Referee::look(const std::vector<Place>& places) {
  if (before_.empty()) before_ = places;
  ways_.resize(places.size(), 0);
  for (std::size_t i = 0; i < places.size(); ++i) {
    ways_[i] += std::hypot(places[i].x - before_[i].x, places[i].y - before_[i].y);
    for (std::size_t j = i + 1; j < places.size(); ++j) {
      // From `from` to `to` goes j as seen from i; the nearest point of that to the origin.
      const Place from{before_[j].x - before_[i].x, before_[j].y - before_[i].y};
      const Place to{places[j].x - places[i].x, places[j].y - places[i].y};
      const Place way{to.x - from.x, to.y - from.y};
      const double square = way.x * way.x + way.y * way.y;
      const double share =
          square > 0 ? std::clamp(-(from.x * way.x + from.y * way.y) / square, 0.0, 1.0) : 0;
      const double gap =
          std::hypot(from.x + share * way.x, from.y + share * way.y) - radii_[i] - radii_[j];
      least_gap_ = std::min(least_gap_, gap);
      if (gap < -1e-6) ++num_contacts_;
    }
  }
  before_ = places;
}

}  // namespace quadrille::dispatch::test
