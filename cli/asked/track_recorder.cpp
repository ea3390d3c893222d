// SPDX-License-Identifier: MIT
#include "asked/track_recorder.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::cli {
namespace {

/// Of a length unit: what is nearer is the same place.
constexpr double kNear = 1e-3;

bool is_near(const view::Sight& sight, double x, double y, double z) {
  return std::abs(sight.x - x) < kNear && std::abs(sight.y - y) < kNear &&
         std::abs(sight.z - z) < kNear;
}

}  // namespace

void TrackRecorder::add(std::size_t agent, std::int64_t time, const Place& place) {
  tracks_.resize(std::max(tracks_.size(), agent + 1));
  view::Track& track = tracks_[agent];
  if (!track.empty() && is_near(track.back(), place.x, place.y, place.z)) {
    track.back().depart = time;
    return;
  }
  // Who goes on as it came has not stopped there.
  if (track.size() > 1 && track.back().arrive == track.back().depart) {
    const view::Sight &from = track[track.size() - 2], &at = track.back();
    const double share =
        static_cast<double>(at.arrive - from.depart) / static_cast<double>(time - from.depart);
    if (is_near(at, from.x + share * (place.x - from.x), from.y + share * (place.y - from.y),
                from.z + share * (place.z - from.z)))
      track.pop_back();
  }
  track.push_back({place.x, place.y, place.z, time, time});
}

}  // namespace quadrille::cli
