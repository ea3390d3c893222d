// SPDX-License-Identifier: MIT
#include "quadrille/fleet/session.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "conversions.hpp"
#include "solving.hpp"

namespace quadrille::fleet {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }

std::optional<Error> refuse_name(const Fleet& fleet, AgentId robot) {
  const std::string name = fleet.name(robot);
  for (const AgentId other : fleet.robot_ids())
    if (other != robot && fleet.name(other) == name)
      return invalid("two robots are called '" + name + "'");
  return std::nullopt;
}

}  // namespace

Result<Session::Member> Session::member(const Fleet& fleet, AgentId robot) {
  const std::string name = "'" + fleet.name(robot) + "'";
  auto agent = fleet.agent(robot);
  if (!agent) return agent.error();
  Member member{std::move(agent).value()};
  const std::optional<UnderWay>& where = fleet.under_way(robot);
  if (!where) return member;
  if (where->may_wait) return invalid(name + " is under way in a session, where it may not wait");
  const auto now = fleet.begin_in_units();
  if (!now) return now.error();
  const auto place = fleet.lane_place(robot, member.agent, *now);
  if (!place) return place.error();
  for (const continuous::EdgeId edge : fleet.edges(where->from, where->to))
    if (fleet.roadmap().in_units()->edge(edge).open_to.contains(member.agent.group))
      member.edge = edge;
  if (!member.edge)
    return invalid(name + " is under way, but no " + fleet.lane_name(where->from, where->to) +
                   " is for it");
  member.behind = place->behind;
  member.agent.start = where->from;
  member.agent.under_way = false;  // It is put there.
  return member;
}

/// In the middle of its move, if it is.
void Session::put(continuous::MemberId id, const Member& member) {
  if (!member.edge) return;
  const auto refused = session_.put_under_way(id, *member.edge, member.behind);
  QUADRILLE_REQUIRE(!refused, "a place within a lane");
}

Result<Session> Session::make(Fleet fleet) {
  for (const AgentId robot : fleet.robot_ids()) fleet.robots_[robot].spec.name = fleet.name(robot);
  const auto now = fleet.begin_in_units();
  if (!now) return now.error();
  auto obstacles = fleet.obstacles_in_units();
  if (!obstacles) return obstacles.error();
  if (const auto agents = fleet.agents(); !agents) return agents.error();
  continuous::Session session(fleet.roadmap().in_units(), fleet.roadmap().unit_sizes(),
                              std::move(obstacles).value(), *now, fleet.releases_whole_moves());
  Session made(std::move(fleet), std::move(session));
  for (const auto& [from, to] : made.fleet_.closed_lanes())
    for (const continuous::EdgeId edge : made.fleet_.edges(from, to))
      if (auto error = made.session_.close(edge)) return *std::move(error);
  for (const AgentId robot : made.fleet_.robot_ids()) {
    const auto member = Session::member(made.fleet_, robot);
    if (!member) return member.error();
    if (auto error = made.add(*member)) return *std::move(error);
  }
  return made;
}

/// What has been converted is what the layer below takes.
std::optional<Error> Session::add(const Member& member) {
  const auto id = session_.add(member.agent);
  if (!id) return id.error();
  put(*id, member);
  members_.push_back(*id);
  ++num_added_;
  return std::nullopt;
}

std::optional<Error> Session::add(RobotSpec spec, const Told& told) {
  Fleet next = fleet_;
  const AgentId robot = next.robot(std::move(spec));
  told(next[robot]);
  std::string& name = next.robots_[robot].spec.name;
  if (name.empty()) name = "robot " + std::to_string(num_added_);
  if (auto error = refuse_name(next, robot)) return error;
  const auto member = Session::member(next, robot);
  if (!member) return member.error();
  if (auto error = add(*member)) return error;
  fleet_ = std::move(next);
  return std::nullopt;
}

Result<AgentId> Session::find(std::string_view robot) const {
  if (const auto found = fleet_.find(robot)) return *found;
  return invalid("there is no robot called '" + std::string(robot) + "'");
}

std::optional<Error> Session::change(std::string_view robot, const Told& told) {
  const auto found = find(robot);
  if (!found) return found.error();
  const std::string name = fleet_.name(*found);
  Fleet next = fleet_;
  told(next[*found]);
  if (next.spec(*found).name.empty()) next.robots_[*found].spec.name = name;
  if (auto error = refuse_name(next, *found)) return error;
  const auto member = Session::member(next, *found);
  if (!member) return member.error();
  if (auto error = session_.change(members_[*found], member->agent)) return error;
  put(members_[*found], *member);
  fleet_ = std::move(next);
  return std::nullopt;
}

std::optional<Error> Session::remove(std::string_view robot) {
  const auto found = find(robot);
  if (!found) return found.error();
  if (auto error = session_.remove(members_[*found])) return error;
  forget_removed();
  return std::nullopt;
}

/// Those that the layer below has no more.
void Session::forget_removed() {
  IdVector<AgentId, continuous::MemberId> members;
  IdVector<AgentId, Fleet::Entry> robots;
  const std::vector<continuous::MemberId> left = session_.members();
  for (const AgentId i : fleet_.robot_ids()) {
    if (!std::binary_search(left.begin(), left.end(), members_[i])) continue;
    members.push_back(members_[i]);
    robots.push_back(std::move(fleet_.robots_[i]));
  }
  members_ = std::move(members);
  fleet_.robots_ = std::move(robots);
}

std::optional<Error> Session::assign(std::string_view robot, std::vector<VertexId> goals) {
  const auto found = find(robot);
  if (!found) return found.error();
  if (goals.empty()) return invalid("'" + fleet_.name(*found) + "' is sent nowhere");
  for (const VertexId goal : goals)
    if (goal.index() >= fleet_.roadmap().num_vertices())
      return invalid("'" + fleet_.name(*found) + "' is sent to vertex " +
                     std::to_string(goal.index()) + ", which the roadmap does not have");
  if (auto error = session_.assign(members_[*found], Goals(goals))) return error;
  static_cast<void>(fleet_[*found].to_any(std::move(goals)));
  return std::nullopt;
}

std::optional<Error> Session::close(VertexId from, VertexId to) {
  if (auto error = fleet_.close(from, to)) return error;
  for (const continuous::EdgeId edge : fleet_.edges(from, to))
    if (auto error = session_.close(edge)) return error;
  return std::nullopt;
}

std::optional<Error> Session::open(VertexId from, VertexId to) {
  if (auto error = fleet_.open(from, to)) return error;
  for (const continuous::EdgeId edge : fleet_.edges(from, to))
    if (auto error = session_.open(edge)) return error;
  return std::nullopt;
}

/// Why the plan has not been followed: the layer below has numbers and ticks.
Error Session::in_words(const Error& error, const TimedPlan& plan) const {
  const auto report = verify(fleet_, plan.in_units());
  if (!report) return report.error();
  if (report->valid()) return error;
  return {error.code, report->violations.front().message, {}};
}

std::optional<Error> Session::advance_to(Seconds now, const TimedPlan& plan) {
  const continuous::Resolution units = fleet_.roadmap().unit_sizes();
  const auto time = continuous::quantise_time(now.value(), units);
  if (!time)
    return out_of_range("the session goes on to " + to_string(now) +
                        ", which is negative, or too late");
  if (*time < session_.now())
    return out_of_range("time goes back from " + to_string(this->now()) + " to " + to_string(now));
  if (auto error = refuse_other_units(fleet_, plan, "the plan")) return error;
  if (const auto error = session_.advance_to(*time, plan.in_units())) return in_words(*error, plan);
  const Seconds begin = in_seconds(*time, units);
  for (const AgentId i : fleet_.robot_ids()) {
    static_cast<void>(fleet_[i].from(plan[i], begin));
    if (fleet_.under_way(i)) fleet_.robots_[i].release = {};
  }
  fleet_.begins_at(begin);
  forget_removed();
  return std::nullopt;
}

Result<SolveOutcome> Session::solve(const SolveOptions& options) {
  return solve_with(fleet_, options,
                    [this](const continuous::Instance&, const continuous::SolveOptions& asked) {
                      return session_.solve(asked);
                    });
}

}  // namespace quadrille::fleet
