// SPDX-License-Identifier: MIT
#include "timed/checker.hpp"

#include <algorithm>
#include <string>

#include "timed/meeting.hpp"

namespace quadrille_check {

namespace {

/// Moves and stays one after the other, the last one for ever.
std::vector<Motion> replay(const Road& road, int agent, const std::vector<Int>& path) {
  const Road::Agent& task = road.agents[static_cast<std::size_t>(agent)];
  const auto point = [&](Int vertex) { return road.points[static_cast<std::size_t>(vertex)]; };
  require(path.size() % 3 == 0, "a path has moves of three numbers");
  std::vector<Motion> motions;
  Int at = task.start, time = 0;
  for (std::size_t k = 0; k < path.size(); k += 3) {
    const Int to = path[k], depart = path[k + 1], arrive = path[k + 2];
    require(!task.under_way || k > 0 || depart == 0, "a path of the plan waits before it goes on");
    require(depart >= time && depart >= task.release && arrive > depart && arrive < kNever,
            "a path of the plan goes back in time, or begins before its release");
    const auto& edges = road.out[static_cast<std::size_t>(at)];
    require(std::any_of(edges.begin(), edges.end(),
                        [&](int e) {
                          return road.edges[static_cast<std::size_t>(e)].to == to &&
                                 road.may_use(agent, e) &&
                                 road.duration(agent, e) == arrive - depart;
                        }),
            "a path of the plan has a move that there is not");
    motions.push_back({point(at), point(at), time, depart, task.body});
    motions.push_back({point(at), point(to), depart, arrive, task.body});
    at = to;
    time = arrive;
  }
  require(at == task.goal && time <= task.deadline,
          "a path of the plan ends elsewhere, or too late");
  motions.push_back({point(at), point(at), time, task.leaves ? time : kNever, task.body});
  return motions;
}

bool do_collide(const std::vector<Motion>& a, const std::vector<Motion>& b) {
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (do_meet(a[i], b[j])) return true;
    if (a[i].end <= b[j].end)
      ++i;
    else
      ++j;
  }
  return false;
}

}  // namespace

TimedChecker::TimedChecker(const Road& road)
    : CheckerFrame(road.agents.size()),
      road_(road),
      meanings_(road),
      rules_(road, meanings_),
      cover_(clauses_, meanings_, rules_.free_costs()) {}

void TimedChecker::check_own(const Record& record) {
  switch (record.tag) {
    case 'u':
      require(clauses_.last() == 0 && record.values.size() == 1,
              "a known cost comes before all clauses");
      rules_.count_below(record.values[0], is_makespan());
      below_ = record.values[0];
      return;
    case 'f':
    case 'c':
      return meanings_.add(record);
    case 'm':
      return rules_.add_contact(record);
    case 'b':
      require(record.values.size() == 1 && cover_.bound() == 0, "costs are raised before trees");
      return rules_.raise_free_cost(clauses_[record.values[0]]);
    case 't':
      return cover_.add(record.values);
    default:
      throw Rejected("no such record");
  }
}

void TimedChecker::require_infeasible(std::span<const Int> values) const {
  require(values.size() == 1 && !below_ && clauses_[values[0]].empty(),
          "that there is no plan is said by an empty clause, about all plans");
}

/// By the trees or by a clause, of which one literal is true; what does not cost less than what is
/// known is not spoken of.
Int TimedChecker::proved(Int clause) const {
  const std::vector<Int>& free_costs = rules_.free_costs();
  Int least = kNever;
  if (clause == 0) {
    least = 0;
    if (!is_makespan())
      least = rules_.free_sum() + cover_.bound();
    else if (!free_costs.empty())
      least = *std::max_element(free_costs.begin(), free_costs.end());
  } else {
    for (const Int lit : clauses_[clause]) {
      const auto level = meanings_.at_least(lit);
      require(level.has_value(), "a claim follows from costs");
      const Int more = level->second - free_costs[static_cast<std::size_t>(level->first)];
      least = std::min(least,
                       is_makespan() ? level->second : rules_.free_sum() + std::max<Int>(0, more));
    }
  }
  return std::min(below_.value_or(kNever), least);
}

Int TimedChecker::plan_cost(const std::vector<Ints>& paths) const {
  std::vector<std::vector<Motion>> motions;
  Int cost = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    motions.push_back(replay(road_, static_cast<int>(i), paths[i]));
    const Int own = motions.back().back().begin;
    require(own <= kNever - cost, "the plan is too long");
    cost = is_makespan() ? std::max(cost, own) : cost + own;
    for (std::size_t j = 0; j < i; ++j)
      require(!do_collide(motions[i], motions[j]), "two agents of the plan collide");
    for (const std::vector<Motion>& obstacle : road_.obstacles)
      require(!do_collide(motions[i], obstacle), "an agent of the plan collides with an obstacle");
  }
  return cost;
}

}  // namespace quadrille_check
