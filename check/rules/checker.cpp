// SPDX-License-Identifier: MIT
#include "rules/checker.hpp"

#include <algorithm>
#include <unordered_map>

#include "rules/infeasible.hpp"

namespace quadrille_check {

Checker::Checker(const Instance& instance)
    : instance_(instance),
      distances_(instance),
      meanings_(instance),
      ledger_(instance, meanings_),
      one_agent_(instance, meanings_, distances_),
      paths_(instance.agents().size()) {}

void Checker::check(const Record& record) {
  if (record.tag == 'i') return check_head(record);
  require(is_makespan_.has_value(), "the head comes first");
  require(!is_infeasible_ && (!claim_ || record.tag == 'p'),
          "nothing but the plan comes after the claim");
  const auto value = [&](std::size_t k) {
    require(k < record.values.size(), "the record is too short");
    return record.values[k];
  };
  switch (record.tag) {
    case 'f':
    case 'c':
    case 'x':
    case 's':
      return meanings_.add_variable(record);
    case 'n':
      return meanings_.add_node(record);
    case 'a':
      return check_axiom(record);
    case 'l':
      return check_derived(record);
    case 'd':
      for (const Int number : record.values) clauses_.remove(number);
      return;
    case 'k':
      return ledger_.pay(clauses_[value(0)], value(1));
    case 'e':
      return ledger_.count_excess(value(0));
    case 'q':
      return check_claim(record);
    case 'p':
      return add_path(record);
    case 'z':
      require(quadrille_check::is_infeasible(instance_, record.values),
              "the agents could come to their goals for all that is said");
      is_infeasible_ = true;
      return;
    default:
      throw Rejected("no such record");
  }
}

void Checker::check_head(const Record& record) {
  require(!is_makespan_, "there is one head");
  require(record.values.size() == 2 && (record.values[1] == 0 || record.values[1] == 1),
          "a head has a number of agents and an objective");
  require(record.values[0] == static_cast<Int>(instance_.agents().size()),
          "the certificate is about another number of agents");
  is_makespan_ = record.values[1] == 1;
}

void Checker::check_axiom(const Record& record) {
  const auto parameters = record.parameters();
  const auto clause = record.literals();
  for (const Int lit : clause) static_cast<void>(meanings_.variable(lit));
  bool holds = false;
  switch (record.values[0]) {
    case 1:
      require(parameters.size() == 1 && parameters[0] >= 0 &&
                  parameters[0] < static_cast<Int>(instance_.agents().size()),
              "rule 1 has an agent");
      holds = one_agent_.holds(static_cast<int>(parameters[0]), clause);
      break;
    case 2:
      holds = is_same_place(meanings_, clause);
      break;
    case 3:
      holds = is_swap(meanings_, clause);
      break;
    case 4:
      holds = is_rectangle(instance_, meanings_, clause, parameters);
      break;
    case 5:
      holds = is_corridor(instance_, meanings_, distances_, clause, parameters);
      break;
    case 6:
      holds = is_sum(meanings_, clause);
      break;
    case 7:
      holds = is_order(meanings_, clause);
      break;
    default:
      throw Rejected("no such rule");
  }
  if (!holds) throw Rejected("rule " + std::to_string(record.values[0]) + " does not say so");
  clauses_.add(clause);
}

void Checker::check_derived(const Record& record) {
  const auto clause = record.derived();
  for (const Int lit : clause) static_cast<void>(meanings_.variable(lit));
  require(clauses_.implied(clause, record.hints(), meanings_.num_variables()),
          "the clause does not follow from its hints");
  clauses_.add(clause);
}

void Checker::check_claim(const Record& record) {
  require(record.values.size() == 2, "a claim has a bound and a clause");
  std::optional<std::vector<Int>> clause;
  if (record.values[1] != 0) clause = clauses_[record.values[1]];
  require(record.values[0] >= 0 && record.values[0] <= ledger_.bound(clause, *is_makespan_),
          "the claim is more than what was proved");
  claim_ = record.values[0];
}

void Checker::add_path(const Record& record) {
  require(record.values.size() >= 2, "a path has an agent and places");
  const Int agent = record.values[0];
  require(agent >= 0 && agent < static_cast<Int>(paths_.size()), "no such agent");
  auto& path = paths_[static_cast<std::size_t>(agent)];
  require(path.empty(), "an agent has two paths");
  for (std::size_t k = 1; k < record.values.size(); ++k) {
    require(instance_.has(record.values[k]), "no such place");
    path.push_back(static_cast<int>(record.values[k]));
  }
}

Verdict Checker::verdict() const {
  if (is_infeasible_) return {*is_makespan_, true, 0, std::nullopt};
  require(claim_.has_value(), "there is no claim");
  Verdict verdict{*is_makespan_, false, *claim_, std::nullopt};
  const auto is_missing = [](const auto& path) { return path.empty(); };
  const auto missing = std::count_if(paths_.begin(), paths_.end(), is_missing);
  if (missing == static_cast<std::ptrdiff_t>(paths_.size()) && !paths_.empty()) return verdict;
  require(missing == 0, "an agent of the plan has no path");
  verdict.cost = cost_of(instance_, paths_, *is_makespan_);
  require(*verdict.cost >= verdict.bound, "the plan costs less than the claim");
  return verdict;
}

Int cost_of(const Instance& instance, const std::vector<std::vector<int>>& paths,
            bool is_makespan) {
  std::size_t end = 0;
  Int cost = 0;
  for (std::size_t a = 0; a < paths.size(); ++a) {
    const std::vector<int>& path = paths[a];
    const Instance::Agent& agent = instance.agents()[a];
    require(path.front() == agent.start && path.back() == agent.goal,
            "a path of the plan has another start or goal");
    for (std::size_t t = 0; t + 1 < path.size(); ++t)
      require(path[t] == path[t + 1] || instance.are_joined(path[t], path[t + 1]),
              "a path of the plan jumps");
    std::size_t arrival = path.size() - 1;
    while (arrival > 0 && path[arrival - 1] == agent.goal) --arrival;
    const Int own = static_cast<Int>(arrival);
    cost = is_makespan ? std::max(cost, own) : cost + own;
    end = std::max(end, path.size());
  }
  const auto where = [&](std::size_t a, std::size_t t) {
    return paths[a][std::min(t, paths[a].size() - 1)];
  };
  for (std::size_t t = 0; t < end; ++t) {
    std::unordered_map<int, std::size_t> occupants;
    for (std::size_t a = 0; a < paths.size(); ++a)
      require(occupants.emplace(where(a, t), a).second, "two agents of the plan are in one place");
    for (std::size_t a = 0; a < paths.size(); ++a) {
      const auto other = occupants.find(where(a, t + 1));
      require(other == occupants.end() || other->second == a ||
                  where(other->second, t + 1) != where(a, t),
              "two agents of the plan swap places");
    }
  }
  return cost;
}

}  // namespace quadrille_check
