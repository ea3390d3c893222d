// SPDX-License-Identifier: MIT
#include "asked/track_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace quadrille::cli {
namespace {

/// Of a length unit: what is nearer is the same place.
constexpr double kNear = 1e-3;

/// Of a degree, likewise.
constexpr double kSameHeading = 1e-3;

/// By which angle it turns, in degrees, the shorter way.
double turn(const std::optional<double>& from, const std::optional<double>& to) {
  return from && to ? std::remainder(*to - *from, 360) : 0;
}

bool is_near(const view::Sight& sight, const TrackRecorder::Place& place) {
  return std::abs(sight.x - place.x) < kNear && std::abs(sight.y - place.y) < kNear &&
         std::abs(sight.z - place.z) < kNear &&
         std::abs(turn(sight.heading, place.heading)) < kSameHeading;
}

/// Where who goes from the sight to the place is after a share of the way.
TrackRecorder::Place between(const view::Sight& from, const TrackRecorder::Place& to,
                             double share) {
  TrackRecorder::Place place{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                             from.z + share * (to.z - from.z)};
  if (from.heading) place.heading = *from.heading + share * turn(from.heading, to.heading);
  return place;
}

}  // namespace

void TrackRecorder::add(std::size_t agent, std::int64_t time, const Place& place) {
  tracks_.resize(std::max(tracks_.size(), agent + 1));
  view::Track& track = tracks_[agent];
  if (!track.empty() && is_near(track.back(), place)) {
    track.back().depart = time;
    return;
  }
  // Who goes on as it came has not stopped there.
  if (track.size() > 1 && track.back().arrive == track.back().depart) {
    const view::Sight &from = track[track.size() - 2], &at = track.back();
    const double share =
        static_cast<double>(at.arrive - from.depart) / static_cast<double>(time - from.depart);
    if (is_near(at, between(from, place, share))) track.pop_back();
  }
  track.push_back({place.x, place.y, place.z, time, time, place.heading});
}

}  // namespace quadrille::cli
