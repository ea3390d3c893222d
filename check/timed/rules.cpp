// SPDX-License-Identifier: MIT
#include "timed/rules.hpp"

#include <algorithm>

#include "timed/meeting.hpp"

namespace quadrille_check {
namespace {

constexpr Int kPaths = 11, kEncounter = 12, kCeiling = 13;

Motion move(const Road& road, int agent, int edge, Int begin) {
  const Road::Edge& e = road.edges[static_cast<std::size_t>(edge)];
  return {road.points[static_cast<std::size_t>(e.from)],
          road.points[static_cast<std::size_t>(e.to)], begin, begin + road.duration(agent, edge),
          road.agents[static_cast<std::size_t>(agent)].radius};
}
Motion stay(const Road& road, int agent, int vertex, Int begin, Int end) {
  const Road::Point& at = road.points[static_cast<std::size_t>(vertex)];
  return {at, at, begin, end, road.agents[static_cast<std::size_t>(agent)].radius};
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
    if (x.agent != agent || !std::any_of(clause.begin(), clause.end(),
                                         [&](Int lit) { return is_kept_out(lit, variable); }))
      return false;
    keep(x);
  }
  most = std::min(most, road_.agents[static_cast<std::size_t>(agent)].deadline);
  return most <= more_than || !paths_.arrival(agent, bans, most);
}

bool TimedRules::is_encounter(std::span<const Int> clause) const {
  if (clause.size() != 2 || clause[0] < 0 || clause[1] < 0) return false;
  const TimedVariable &x = meanings_.variable(clause[0]), &y = meanings_.variable(clause[1]);
  if (x.agent == y.agent || x.kind != TimedVariable::Kind::does_not || x.kind != y.kind)
    return false;
  return std::all_of(x.bans.begin(), x.bans.end(), [&](const TimedBan& a) {
    return std::all_of(y.bans.begin(), y.bans.end(),
                       [&](const TimedBan& b) { return do_all_meet(x.agent, a, y.agent, b); });
  });
}

// Which starts meet, and which moments of a move, are convex sets: the extreme ones decide.
bool TimedRules::do_all_meet(int i, const TimedBan& a, int j, const TimedBan& b) const {
  if (a.is_stay) return !b.is_stay && do_all_meet(j, b, i, a);
  if (a.end == kNever || b.end == kNever) return false;
  const Int first = a.begin, last = a.end - 1;
  const auto meet = [&](Int start, const Motion& other) {
    return do_meet(move(road_, i, a.place, start), other);
  };
  if (!b.is_stay)
    return meet(first, move(road_, j, b.place, b.end - 1)) &&
           meet(last, move(road_, j, b.place, b.begin));
  // A stay that breaks the ban is there at one of the moments between, or else the whole tick.
  Int early = b.begin + 1, late = b.end - 1;
  const Int width = late < early ? 1 : 0;
  if (width == 1) early = late = b.begin;
  for (const Int start : {first, last})
    for (const Int moment : {early, late})
      if (!meet(start, stay(road_, j, b.place, moment, moment + width))) return false;
  return true;
}

// "The agent does none of that" while another one, which costs less, rests at its goal.
bool TimedRules::is_kept_out(Int lit, Int variable) {
  const auto resident = meanings_.at_least(lit);
  const TimedVariable& x = meanings_.variable(variable);
  if (!resident || resident->first == x.agent || x.kind != TimedVariable::Kind::does_not)
    return false;
  if (kept_out_.count({lit, variable}) != 0) return true;
  for (const TimedBan& ban : x.bans)
    if (!is_kept_out(x.agent, ban, resident->first, resident->second - 1)) return false;
  kept_out_.insert({lit, variable});
  return true;
}

// The resident is there from `from` on, at the latest. Who sets out later meets it no less: the
// contact ends later.
bool TimedRules::is_kept_out(int i, const TimedBan& ban, int resident, Int from) const {
  const int goal = road_.agents[static_cast<std::size_t>(resident)].goal;
  if (ban.is_stay)
    return ban.begin >= from &&
           do_meet(stay(road_, i, ban.place, from, from), stay(road_, resident, goal, from, from));
  const Motion moving = move(road_, i, ban.place, std::max<Int>(ban.begin, 0));
  const Int meeting = std::max(from, moving.begin);
  return meeting <= moving.end && do_meet(moving, stay(road_, resident, goal, meeting, moving.end));
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
