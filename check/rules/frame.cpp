// SPDX-License-Identifier: MIT
#include "rules/frame.hpp"

#include <string>

namespace quadrille_check {

void CheckerFrame::check(const Record& record) {
  if (record.tag == 'i') return check_head(record);
  require(is_makespan_.has_value(), "the head comes first");
  require(!is_infeasible_ && (!claim_ || record.tag == 'p'),
          "nothing but the plan comes after the claim");
  switch (record.tag) {
    case 'a':
      return check_axiom(record);
    case 'l':
      return check_derived(record);
    case 'd':
      for (const Int number : record.values) clauses_.remove(number);
      return;
    case 'q':
      return check_claim(record);
    case 'p':
      return add_path(record);
    case 'z':
      require_infeasible(record.values);
      is_infeasible_ = true;
      return;
    default:
      return check_own(record);
  }
}

void CheckerFrame::check_head(const Record& record) {
  require(!is_makespan_, "there is one head");
  require(record.values.size() == 2 && (record.values[1] == 0 || record.values[1] == 1),
          "a head has a number of agents and an objective");
  require(record.values[0] == static_cast<Int>(paths_.size()),
          "the certificate is about another number of agents");
  is_makespan_ = record.values[1] == 1;
}

void CheckerFrame::check_axiom(const Record& record) {
  const auto parameters = record.parameters();
  const auto clause = record.literals();
  for (const Int lit : clause) require_meaning(lit);
  if (!holds(record.values[0], parameters, clause))
    throw Rejected("rule " + std::to_string(record.values[0]) + " does not say so");
  clauses_.add(clause);
}

void CheckerFrame::check_derived(const Record& record) {
  const auto clause = record.derived();
  for (const Int lit : clause) require_meaning(lit);
  require(clauses_.implied(clause, record.hints()), "the clause does not follow from its hints");
  clauses_.add(clause);
}

void CheckerFrame::check_claim(const Record& record) {
  require(record.values.size() == 2, "a claim has a bound and a clause");
  require(record.values[0] >= 0 && record.values[0] <= proved(record.values[1]),
          "the claim is more than what was proved");
  claim_ = record.values[0];
}

void CheckerFrame::add_path(const Record& record) {
  require(!record.values.empty(), "a path has an agent");
  const Int agent = record.values[0];
  require(agent >= 0 && agent < static_cast<Int>(paths_.size()), "no such agent");
  auto& path = paths_[static_cast<std::size_t>(agent)];
  require(!path, "an agent has two paths");
  path.emplace(record.values.begin() + 1, record.values.end());
}

Verdict CheckerFrame::verdict() const {
  if (is_infeasible_) return {is_makespan(), true, 0, std::nullopt};
  require(claim_.has_value(), "there is no claim");
  Verdict verdict{is_makespan(), false, *claim_, std::nullopt};
  std::vector<Ints> paths;
  for (const auto& path : paths_)
    if (path) paths.push_back(*path);
  if (paths.empty() && !paths_.empty()) return verdict;
  require(paths.size() == paths_.size(), "an agent of the plan has no path");
  verdict.cost = plan_cost(paths);
  require(*verdict.cost >= verdict.bound, "the plan costs less than the claim");
  return verdict;
}

}  // namespace quadrille_check
