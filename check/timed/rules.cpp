// SPDX-License-Identifier: MIT
#include "timed/rules.hpp"

#include <algorithm>

#include "timed/meeting.hpp"

namespace quadrille_check {
namespace {

/// Of two agents' bans: no search makes so many, and no file keeps the checker for hours.
constexpr std::size_t kMostPairs = 1'000'000;
constexpr Int kPaths = 11, kEncounter = 12, kCeiling = 13;

Motion move(const Road& road, int agent, int edge, Int begin) {
  const Road::Edge& e = road.edges[static_cast<std::size_t>(edge)];
  return {road.points[static_cast<std::size_t>(e.from)],
          road.points[static_cast<std::size_t>(e.to)], begin, begin + road.duration(agent, edge),
          road.agents[static_cast<std::size_t>(agent)].body};
}
Motion stay(const Road& road, int agent, int vertex, Int begin, Int end) {
  const Road::Point& at = road.points[static_cast<std::size_t>(vertex)];
  return {at, at, begin, end, road.agents[static_cast<std::size_t>(agent)].body};
}

}  // namespace

TimedRules::TimedRules(const Road& road, const TimedMeanings& meanings)
    : road_(road), meanings_(meanings), paths_(road) {
  for (int agent = 0; agent < static_cast<int>(road.agents.size()); ++agent) {
    const auto cost = paths_.arrival(agent, {}, kNever - 1);
    if (!cost) throw BadInput("an agent cannot come to its goal");
    free_costs_.push_back(*cost);
    free_sum_ += *cost;
  }
}

void TimedRules::count_below(Int cost, bool is_makespan) {
  require(!below_ && cost >= 0 && cost < kNever, "there is one known cost");
  below_ = cost;
  is_makespan_ = is_makespan;
}

bool TimedRules::holds(Int rule, std::span<const Int> parameters, std::span<const Int> clause) {
  for (const Int lit : clause) static_cast<void>(meanings_.variable(lit));
  if (rule == kPaths) return has_no_path(parameters, clause);
  if (rule == kEncounter) return is_encounter(clause);
  require(rule == kCeiling, "no such rule");
  return is_ceiling(clause);
}

// What the negated literals say of the agent. Whatever else they say is left out.
bool TimedRules::has_no_path(std::span<const Int> parameters, std::span<const Int> clause) {
  require(!parameters.empty(), "the rule has an agent");
  const int agent = meanings_.agent(parameters[0]);
  Int most = kNever - 1, more_than = -1;
  std::vector<const TimedBan*> bans;
  const auto keep = [&](const TimedVariable& x) {
    for (const TimedBan& ban : x.bans) bans.push_back(&ban);
  };
  for (const Int lit : clause) {
    const TimedVariable& x = meanings_.variable(lit);
    if (x.agent != agent) continue;
    if (x.kind == TimedVariable::Kind::does_not) {
      if (lit < 0) keep(x);
    } else if (lit < 0) {
      most = std::min(most, x.number);
    } else {
      more_than = std::max(more_than, x.number);
    }
  }
  for (const Int variable : parameters.subspan(1)) {
    const TimedVariable& x = meanings_.variable(variable);
    const auto is_due_to = [&](Int lit) { return is_kept_out(lit, variable); };
    if (x.agent != agent || (std::none_of(clause.begin(), clause.end(), is_due_to) &&
                             !is_kept_out_by_obstacles(variable)))
      return false;
    keep(x);
  }
  most = std::min(most, road_.agents[static_cast<std::size_t>(agent)].deadline);
  return most <= more_than || !paths_.arrival(agent, bans, most);
}

bool TimedRules::is_encounter(std::span<const Int> clause) const {
  if (clause.size() != 2 || clause[0] < 0 || clause[1] < 0) return false;
  const TimedVariable &x = meanings_.variable(clause[0]), &y = meanings_.variable(clause[1]);
  if (x.bans.size() * y.bans.size() > kMostPairs) return false;
  if (x.agent == y.agent || x.kind != TimedVariable::Kind::does_not || x.kind != y.kind)
    return false;
  return std::all_of(x.bans.begin(), x.bans.end(), [&](const TimedBan& a) {
    return std::all_of(y.bans.begin(), y.bans.end(),
                       [&](const TimedBan& b) { return do_all_meet(x.agent, a, y.agent, b); });
  });
}

// By convexity the extreme starts of the other one decide.
bool TimedRules::do_all_meet(int i, const TimedBan& a, int j, const TimedBan& b) const {
  if (b.is_stay) return !a.is_stay && do_all_meet(j, b, i, a);
  return b.end < kNever && is_in_the_way(move(road_, j, b.place, b.begin), i, a) &&
         is_in_the_way(move(road_, j, b.place, b.end - 1), i, a);
}

// The starts that meet a motion are an interval, and so are the moments at which it is in contact
// with a place: the extreme ones decide. Of one that stands for ever both have no end.
bool TimedRules::is_in_the_way(const Motion& other, int i, const TimedBan& ban) const {
  const bool is_for_ever = ban.end == kNever;
  if (is_for_ever && other.end < kNever) return false;
  if (!ban.is_stay)
    return do_meet(move(road_, i, ban.place, std::max<Int>(ban.begin, 0)), other) &&
           (is_for_ever || do_meet(move(road_, i, ban.place, ban.end - 1), other));
  // A stay that breaks the ban is there at one of the ticks between, or else from one to the next.
  const auto is_met = [&](Int begin, Int end) {
    return do_meet(stay(road_, i, ban.place, begin, end), other);
  };
  if (ban.end == ban.begin + 1) return is_met(ban.begin, ban.end);
  return is_met(ban.begin + 1, ban.begin + 1) && (is_for_ever || is_met(ban.end - 1, ban.end - 1));
}

// "The agent does none of that" while another one, which costs less, rests at its goal.
bool TimedRules::is_kept_out(Int lit, Int variable) {
  const auto resident = meanings_.at_least(lit);
  const TimedVariable& x = meanings_.variable(variable);
  if (!resident || resident->first == x.agent || x.kind != TimedVariable::Kind::does_not)
    return false;
  const Road::Agent& other = road_.agents[static_cast<std::size_t>(resident->first)];
  if (other.leaves) return false;
  if (kept_out_.count({lit, variable}) != 0) return true;
  const Motion resting =
      stay(road_, resident->first, other.goal, std::max<Int>(resident->second - 1, 0), kNever);
  for (const TimedBan& ban : x.bans)
    if (!is_in_the_way(resting, x.agent, ban)) return false;
  kept_out_.insert({lit, variable});
  return true;
}

// Each of its bans by one stretch of an obstacle's path.
bool TimedRules::is_kept_out_by_obstacles(Int variable) {
  const TimedVariable& x = meanings_.variable(variable);
  if (x.kind != TimedVariable::Kind::does_not) return false;
  if (kept_out_.count({0, variable}) != 0) return true;
  for (const TimedBan& ban : x.bans)
    if (std::none_of(road_.obstacles.begin(), road_.obstacles.end(), [&](const auto& motions) {
          return std::any_of(motions.begin(), motions.end(), [&](const Motion& motion) {
            return is_in_the_way(motion, x.agent, ban);
          });
        }))
      return false;
  kept_out_.insert({0, variable});
  return true;
}

void TimedRules::raise_free_cost(std::span<const Int> clause) {
  require(clause.size() == 1, "a cost that an agent has at least is said by one literal");
  const auto level = meanings_.at_least(clause[0]);
  require(level.has_value(), "a literal says nothing of a cost");
  Int& known = free_costs_[static_cast<std::size_t>(level->first)];
  if (level->second <= known) return;
  require(level->second <= kNever - free_sum_, "a cost is too large");
  free_sum_ += level->second - known;
  known = level->second;
}

// Who costs more than that, while the others cost what they do at least, is in no plan that counts.
bool TimedRules::is_ceiling(std::span<const Int> clause) const {
  return below_ && std::any_of(clause.begin(), clause.end(), [&](Int lit) {
           const TimedVariable& x = meanings_.variable(lit);
           if (lit < 0 || x.kind != TimedVariable::Kind::costs_at_most) return false;
           const Int others =
               is_makespan_ ? 0 : free_sum_ - free_costs_[static_cast<std::size_t>(x.agent)];
           return x.number + 1 + others >= *below_;
         });
}

}  // namespace quadrille_check
