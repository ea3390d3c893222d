// SPDX-License-Identifier: MIT
#include "origin.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::dispatch {

NewOrigin move_origin(std::span<const Course> courses, std::span<const Ticks> clocks,
                      std::span<const Ticks> limits, Ticks now) {
  // Whoever has been allowed to arrive is at rest, and early for ever.
  const auto has_ended = [&](std::size_t i) { return limits[i] >= end_of(courses[i]); };
  std::optional<Ticks> earliest;
  for (std::size_t i = 0; i < courses.size(); ++i)
    if (!has_ended(i)) earliest = std::min(earliest.value_or(limits[i]), limits[i]);
  NewOrigin made;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Course& course = courses[i];
    const Ticks reached = std::min(limits[i], end_of(course));
    const Ticks clock = std::min(clocks[i], reached);
    Course done = shifted(since(until(course, reached), clock), now - reached);
    // Where it is counts from its clock on, however long it has been there.
    Course rest{{course.back().spot, now, now}};
    if (!has_ended(i)) {
      rest = shifted(since(course, reached), now - *earliest);
      rest.front().arrive = now;
    }
    made.courses.push_back(joined(std::move(done), rest));
    made.clocks.push_back(clock + (now - reached));
  }
  return made;
}

}  // namespace quadrille::dispatch
