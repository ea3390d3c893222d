// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/course.hpp"

#include <algorithm>
#include <cstddef>

#include "quadrille/core/contract.hpp"

namespace quadrille::dispatch {
namespace {

/// The last stop that has begun by then.
std::size_t stop_at(const Course& course, Ticks time) {
  std::size_t k = 0;
  while (k + 1 < course.size() && course[k + 1].arrive <= time) ++k;
  return k;
}

/// On the way from a stop to the next one, so long after its beginning.
Spot between(const Stop& stop, const Stop& next, Ticks time) {
  if (!stop.spot.is_vertex())
    return {stop.spot.from, stop.spot.to, stop.spot.behind + (time - stop.depart), stop.spot.whole};
  if (!next.spot.is_vertex())
    return {next.spot.from, next.spot.to, time - stop.depart, next.spot.whole};
  return {stop.spot.from, next.spot.from, time - stop.depart, next.arrive - stop.depart};
}

}  // namespace

Spot spot_at(const Course& course, Ticks time) {
  const std::size_t k = stop_at(course, time);
  if (k + 1 == course.size() || time <= course[k].depart) return course[k].spot;
  return between(course[k], course[k + 1], time);
}

bool stands_at(const Course& course, Ticks time) {
  const std::size_t k = stop_at(course, time);
  return k + 1 == course.size() || time < course[k].depart;
}

Course since(const Course& course, Ticks time) {
  const std::size_t k = stop_at(course, time);
  const bool is_last = k + 1 == course.size();
  Course rest{{spot_at(course, time), time, is_last ? time : std::max(time, course[k].depart)}};
  rest.insert(rest.end(), course.begin() + static_cast<std::ptrdiff_t>(k) + 1, course.end());
  return rest;
}

Course until(const Course& course, Ticks time) {
  const std::size_t k = stop_at(course, time);
  Course done(course.begin(), course.begin() + static_cast<std::ptrdiff_t>(k) + 1);
  if (k + 1 == course.size() || time <= course[k].depart) {
    done.back().depart = std::max(time, done.back().arrive);
  } else {
    done.push_back({spot_at(course, time), time, time});
  }
  return done;
}

Course joined(Course first, const Course& second) {
  QUADRILLE_REQUIRE(!first.empty() && !second.empty(), "a course has a stop");
  QUADRILLE_REQUIRE(first.back().spot == second.front().spot, "one goes on where the other ends");
  Stop& at = first.back();
  at.depart = second.front().depart;
  const bool passes = !at.spot.is_vertex() && at.arrive == at.depart && second.size() > 1;
  if (passes && first.size() > 1) first.pop_back();
  first.insert(first.end(), second.begin() + 1, second.end());
  return first;
}

Course shifted(Course course, Ticks by) {
  for (Stop& stop : course) {
    stop.arrive += by;
    stop.depart += by;
  }
  return course;
}

}  // namespace quadrille::dispatch
