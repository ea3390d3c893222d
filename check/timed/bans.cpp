// SPDX-License-Identifier: MIT
#include "timed/bans.hpp"

#include "timed/meeting.hpp"

namespace quadrille_check {

TimedBan read_ban(const Road& road, Int kind, Int place, Int begin, Int end) {
  const std::size_t size = kind == 0 ? road.edges.size() : road.points.size();
  require((kind == 0 || kind == 1) && place >= 0 && place < static_cast<Int>(size),
          "no such place");
  require(begin > -kNever && begin < end && end <= kNever, "a ban ends after it begins");
  return {kind == 1, static_cast<int>(place), begin, end};
}

Motion move_along(const Road& road, int agent, int edge, Int begin) {
  const Road::Edge& e = road.edges[static_cast<std::size_t>(edge)];
  return {road.points[static_cast<std::size_t>(e.from)],
          road.points[static_cast<std::size_t>(e.to)], begin, begin + road.duration(agent, edge),
          road.agents[static_cast<std::size_t>(agent)].body};
}

Motion stay_at(const Road& road, int agent, int vertex, Int begin, Int end) {
  const Road::Point& at = road.points[static_cast<std::size_t>(vertex)];
  return {at, at, begin, end, road.agents[static_cast<std::size_t>(agent)].body};
}

// The starts that meet a motion are an interval, and so are the moments at which it is in contact
// with a place: the extreme ones decide. Of one that stands for ever both have no end.
bool is_in_the_way(const Road& road, const Motion& other, int agent, const TimedBan& ban) {
  const bool is_for_ever = ban.end == kNever;
  if (is_for_ever && other.end < kNever) return false;
  const auto is_met = [&](Int begin, Int end) {
    return do_meet(ban.is_stay ? stay_at(road, agent, ban.place, begin, end)
                               : move_along(road, agent, ban.place, begin),
                   other);
  };
  if (!ban.is_stay) return is_met(ban.begin, 0) && (is_for_ever || is_met(ban.end - 1, 0));
  // A stay that breaks the ban is there at one of the ticks between, or else from one to the next.
  if (ban.end == ban.begin + 1) return is_met(ban.begin, ban.end);
  return is_met(ban.begin + 1, ban.begin + 1) && (is_for_ever || is_met(ban.end - 1, ban.end - 1));
}

}  // namespace quadrille_check
