// SPDX-License-Identifier: MIT
#include "timed/rules.hpp"

#include <algorithm>

#include "timed/meeting.hpp"

namespace quadrille_check {
namespace {

/// Of two agents' bans: no search makes so many, and no file keeps the checker for hours.
constexpr std::size_t kMostPairs = 1'000'000;
constexpr Int kPaths = 11, kEncounter = 12, kCeiling = 13, kPair = 14;

}  // namespace

TimedRules::TimedRules(const Road& road, const TimedMeanings& meanings)
    : road_(road), meanings_(meanings), paths_(road), contacts_(road) {
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
  if (rule == kPaths) return has_no_path(parameters, clause);
  if (rule == kEncounter) return is_encounter(clause);
  if (rule == kPair) return is_pair(parameters, clause);
  require(rule == kCeiling, "no such rule");
  return is_ceiling(clause);
}

struct TimedRules::Demand : TimedParty {
  Int more_than = -1;
  [[nodiscard]] bool is_contradiction() const { return most <= more_than; }
};

// Whatever else the literals say is left out.
std::optional<TimedRules::Demand> TimedRules::demand(Int agent, std::span<const Int> variables,
                                                     std::span<const Int> clause) {
  Demand demand;
  demand.agent = meanings_.agent(agent);
  demand.most = std::min(kNever - 1, road_.agents[static_cast<std::size_t>(demand.agent)].deadline);
  const auto keep = [&](const TimedVariable& x) {
    for (const TimedBan& ban : x.bans) demand.bans.push_back(&ban);
  };
  for (const Int lit : clause) {
    const TimedVariable& x = meanings_.variable(lit);
    if (x.agent != demand.agent) continue;
    if (x.kind == TimedVariable::Kind::does_not) {
      if (lit < 0) keep(x);
    } else if (lit < 0) {
      demand.most = std::min(demand.most, x.number);
    } else {
      demand.more_than = std::max(demand.more_than, x.number);
    }
  }
  for (const Int variable : variables) {
    const TimedVariable& x = meanings_.variable(variable);
    if (x.agent != demand.agent) continue;
    const auto is_due_to = [&](Int lit) { return is_kept_out(lit, variable); };
    if (std::none_of(clause.begin(), clause.end(), is_due_to) &&
        !is_kept_out_by_obstacles(variable))
      return std::nullopt;
    keep(x);
  }
  return demand;
}

bool TimedRules::has_no_path(std::span<const Int> parameters, std::span<const Int> clause) {
  require(!parameters.empty(), "the rule has an agent");
  const auto only = demand(parameters[0], parameters.subspan(1), clause);
  return only && (only->is_contradiction() || !paths_.arrival(only->agent, only->bans, only->most));
}

bool TimedRules::is_pair(std::span<const Int> parameters, std::span<const Int> clause) {
  require(parameters.size() >= 2 && parameters[0] != parameters[1], "the rule has two agents");
  const auto first = demand(parameters[0], parameters.subspan(2), clause),
             second = demand(parameters[1], parameters.subspan(2), clause);
  return first && second && have_no_plan(road_, contacts_, paths_, *first, *second);
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
  return b.end < kNever && is_in_the_way(road_, move_along(road_, j, b.place, b.begin), i, a) &&
         is_in_the_way(road_, move_along(road_, j, b.place, b.end - 1), i, a);
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
      stay_at(road_, resident->first, other.goal, std::max<Int>(resident->second - 1, 0), kNever);
  for (const TimedBan& ban : x.bans)
    if (!is_in_the_way(road_, resting, x.agent, ban)) return false;
  kept_out_.insert({lit, variable});
  return true;
}

// Each of its bans by one stretch of an obstacle's path.
bool TimedRules::is_kept_out_by_obstacles(Int variable) {
  const TimedVariable& x = meanings_.variable(variable);
  if (kept_out_.count({0, variable}) != 0) return true;
  for (const TimedBan& ban : x.bans)
    if (std::none_of(road_.obstacles.begin(), road_.obstacles.end(), [&](const auto& motions) {
          return std::any_of(motions.begin(), motions.end(), [&](const Motion& motion) {
            return is_in_the_way(road_, motion, x.agent, ban);
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
