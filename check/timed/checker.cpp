// SPDX-License-Identifier: MIT
#include "timed/checker.hpp"

#include <algorithm>
#include <string>

#include "timed/meeting.hpp"

namespace quadrille_check {

TimedChecker::TimedChecker(const Road& road)
    : road_(road),
      meanings_(road),
      rules_(road, meanings_),
      cover_(clauses_, meanings_, rules_.free_costs()),
      paths_(road.agents.size()) {}

void TimedChecker::check(const Record& record) {
  if (record.tag == 'i') return check_head(record);
  require(is_makespan_.has_value(), "the head comes first");
  require(!is_infeasible_ && (!claim_ || record.tag == 'p'),
          "nothing but the plan comes after the claim");
  switch (record.tag) {
    case 'u':
      require(!has_clauses_ && record.values.size() == 1, "a known cost comes before all clauses");
      rules_.count_below(record.values[0], *is_makespan_);
      below_ = record.values[0];
      return;
    case 'f':
    case 'c':
      return meanings_.add(record);
    case 'm':
      return rules_.add_contact(record);
    case 'a': {
      const auto parameters = record.parameters();
      const auto clause = record.literals();
      has_clauses_ = true;
      if (!rules_.holds(record.values[0], parameters, clause))
        throw Rejected("rule " + std::to_string(record.values[0]) + " does not say so");
      return clauses_.add(clause);
    }
    case 'l':
      return check_derived(record);
    case 'd':
      for (const Int number : record.values) clauses_.remove(number);
      return;
    case 'b':
      require(record.values.size() == 1 && cover_.bound() == 0, "costs are raised before trees");
      return rules_.raise_free_cost(clauses_[record.values[0]]);
    case 't':
      return cover_.add(record.values);
    case 'z':
      require(record.values.size() == 1 && !below_ && clauses_[record.values[0]].empty(),
              "that there is no plan is said by an empty clause, about all plans");
      is_infeasible_ = true;
      return;
    case 'q':
      return check_claim(record);
    case 'p':
      return add_path(record);
    default:
      throw Rejected("no such record");
  }
}

void TimedChecker::check_head(const Record& record) {
  require(!is_makespan_, "there is one head");
  require(record.values.size() == 2 && (record.values[1] == 0 || record.values[1] == 1),
          "a head has a number of agents and an objective");
  require(record.values[0] == static_cast<Int>(road_.agents.size()),
          "the certificate is about another number of agents");
  is_makespan_ = record.values[1] == 1;
}

void TimedChecker::check_derived(const Record& record) {
  const auto clause = record.derived();
  for (const Int lit : clause) static_cast<void>(meanings_.variable(lit));
  require(clauses_.implied(clause, record.hints(), meanings_.num_variables()),
          "the clause does not follow from its hints");
  clauses_.add(clause);
}

void TimedChecker::check_claim(const Record& record) {
  require(record.values.size() == 2, "a claim has a bound and a clause");
  const Int most = std::min(below_.value_or(kNever), proved(record.values[1]));
  require(record.values[0] >= 0 && record.values[0] <= most,
          "the claim is more than what was proved");
  claim_ = record.values[0];
}

/// What plans that count cost at least, by the trees or by a clause: one of its literals is true.
Int TimedChecker::proved(Int clause) const {
  const std::vector<Int>& free_costs = rules_.free_costs();
  if (clause == 0) {
    if (!*is_makespan_) return rules_.free_sum() + cover_.bound();
    return free_costs.empty() ? 0 : *std::max_element(free_costs.begin(), free_costs.end());
  }
  Int least = kNever;
  for (const Int lit : clauses_[clause]) {
    const auto level = meanings_.at_least(lit);
    require(level.has_value(), "a claim follows from costs");
    const Int more = level->second - free_costs[static_cast<std::size_t>(level->first)];
    least =
        std::min(least, *is_makespan_ ? level->second : rules_.free_sum() + std::max<Int>(0, more));
  }
  return least;
}

void TimedChecker::add_path(const Record& record) {
  require(record.values.size() % 3 == 1, "a path has an agent, and moves of three numbers");
  auto& path = paths_[static_cast<std::size_t>(meanings_.agent(record.values[0]))];
  require(!path, "an agent has two paths");
  path.emplace(record.values.begin() + 1, record.values.end());
}

Verdict TimedChecker::verdict() const {
  if (is_infeasible_) return {*is_makespan_, true, 0, std::nullopt};
  require(claim_.has_value(), "there is no claim");
  Verdict verdict{*is_makespan_, false, *claim_, std::nullopt};
  std::vector<std::vector<Int>> paths;
  for (const auto& path : paths_)
    if (path) paths.push_back(*path);
  if (paths.empty() && !paths_.empty()) return verdict;
  require(paths.size() == paths_.size(), "an agent of the plan has no path");
  verdict.cost = cost_of(road_, paths, *is_makespan_);
  require(*verdict.cost >= verdict.bound, "the plan costs less than the claim");
  return verdict;
}

namespace {

/// Moves and stays one after the other, the last one for ever.
std::vector<Motion> replay(const Road& road, int agent, const std::vector<Int>& path) {
  const Road::Agent& task = road.agents[static_cast<std::size_t>(agent)];
  const auto point = [&](Int vertex) { return road.points[static_cast<std::size_t>(vertex)]; };
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

Int cost_of(const Road& road, const std::vector<std::vector<Int>>& paths, bool is_makespan) {
  std::vector<std::vector<Motion>> motions;
  Int cost = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    motions.push_back(replay(road, static_cast<int>(i), paths[i]));
    const Int own = motions.back().back().begin;
    require(own <= kNever - cost, "the plan is too long");
    cost = is_makespan ? std::max(cost, own) : cost + own;
    for (std::size_t j = 0; j < i; ++j)
      require(!do_collide(motions[i], motions[j]), "two agents of the plan collide");
    for (const std::vector<Motion>& obstacle : road.obstacles)
      require(!do_collide(motions[i], obstacle), "an agent of the plan collides with an obstacle");
  }
  return cost;
}

}  // namespace quadrille_check
