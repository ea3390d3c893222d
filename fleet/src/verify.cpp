// SPDX-License-Identifier: MIT
#include "quadrille/fleet/verify.hpp"

#include "conversions.hpp"

namespace quadrille::fleet {
namespace {

/// What a robot does wrong; `when` is the time, if it has one, `is_at_begin` whether that is when
/// all begin.
std::string message(const Fleet& fleet, const continuous::Violation& violation,
                    const std::string& when, bool is_at_begin) {
  using Kind = continuous::Violation::Kind;
  // A plan may have more paths than the fleet has robots.
  const bool is_known = violation.agent.index() < fleet.num_robots();
  const std::string robot = is_known ? "'" + fleet.name(violation.agent) + "' " : "a path ";
  const auto place = [&](std::optional<VertexId> v) {
    return v ? fleet.roadmap().name(*v) : std::string("nowhere");
  };
  switch (violation.kind) {
    case Kind::path_count:
      return "the plan has not one path for each of the " + std::to_string(fleet.num_robots()) +
             " robots";
    case Kind::empty_path:
      return robot + "has an empty path";
    case Kind::bad_vertex:
      return robot + "comes to a vertex that the roadmap does not have, at " + when;
    case Kind::bad_time:
      return robot + "leaves before it arrives, or at a time that is not supported, at " + when;
    case Kind::wrong_start:
      return robot + "does not begin at " +
             (fleet.start(violation.agent) ? place(fleet.start(violation.agent))
                                           : std::string("its place in the middle of a move"));
    case Kind::wrong_goal:
      if (const auto& goals = fleet.goals(violation.agent); goals && !goals->is_single())
        return robot + "does not end at any of its goals";
      return robot + "does not end at " + place(fleet.goal(violation.agent));
    case Kind::not_adjacent:
      return robot + "moves along no lane at " + when;
    case Kind::waits:
      if (!is_at_begin) return robot + "waits where nobody may, from " + when + " on";
      return robot + "stops at its start, where it is in the middle of a move";
    case Kind::duration:
      return robot + "takes longer or shorter for a lane than it does at its speed, at " + when;
    case Kind::too_early:
      return robot + "begins a move at " + when + ", before its release at " +
             to_string(fleet.release(violation.agent));
    case Kind::too_late:
      return robot + "arrives at " + when + ", after its deadline at " +
             to_string(fleet.deadline(violation.agent).value_or(Seconds(0)));
    case Kind::closed_edge:
      return robot + "moves along a lane that is not for it, at " + when;
    case Kind::obstacle:
      return robot + "and an obstacle collide at " + when;
    case Kind::collision:
      return robot + "and '" + fleet.name(violation.other.value_or(violation.agent)) +
             "' collide at " + when;
    case Kind::whole_moves:
      return robot + "and '" + fleet.name(violation.other.value_or(violation.agent)) +
             "' are under way at " + when +
             " on moves that cross, and moves are released as a whole";
    default:
      return violation.message;
  }
}

}  // namespace

Result<VerifyReport> verify(const Fleet& fleet, const continuous::Plan& plan,
                            std::size_t num_clearances) {
  const auto instance = fleet.instance();
  if (!instance) return instance.error();
  const continuous::Resolution& resolution = instance->resolution();
  const continuous::VerifyReport found = continuous::verify(*instance, plan, num_clearances);
  VerifyReport report;
  for (const continuous::Violation& violation : found.violations) {
    const Seconds time = in_seconds(violation.tick, resolution);
    report.violations.push_back(
        {violation.kind, violation.agent, violation.other, time,
         message(fleet, violation, to_string(time), violation.tick == instance->now())});
  }
  for (const continuous::Clearance& clearance : found.clearances)
    report.clearances.push_back({clearance.agent, clearance.other,
                                 Metres(clearance.gap * resolution.length),
                                 Seconds(clearance.tick * resolution.time)});
  return report;
}

}  // namespace quadrille::fleet
