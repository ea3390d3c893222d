// SPDX-License-Identifier: MIT
#include "solve/makespan_search.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace quadrille::continuous {

using sat::SearchEnd;
using sat::Verdict;

namespace {

/// Raises that the same agents account for are one.
void add_raise(CostTrace& trace, Cost amount, const LevelCore& core) {
  std::vector<AgentId> agents;
  for (const Level& level : core) agents.push_back(level.agent);
  std::vector<Raise>& raises = trace.raises;
  if (!raises.empty() && raises.back().agents == agents)
    raises.back().amount += amount;
  else
    raises.push_back({RaiseKind::core, amount, std::move(agents), {}});
}

}  // namespace

CostReport search_makespan(CostProblem& problem, const CostReport& known, LimitMonitor& limits,
                           Statistics& statistics, Correspondent& correspondent, CostTrace* trace) {
  CostReport report = known;
  const Model& model = problem.model();
  for (const AgentId i : model.instance().agent_ids())
    report.lower_bound = std::max(report.lower_bound, model.free_cost(i));
  while (true) {
    const Message heard = correspondent.report(report);
    report.lower_bound = std::max(report.lower_bound, heard.lower);
    if (heard.plan && (!report.plan || heard.cost < cost(*report.plan, Objective::makespan)))
      report.plan = *heard.plan;
    if (report.plan && cost(*report.plan, Objective::makespan) <= report.lower_bound) {
      report.end = SearchEnd::found;
      return report;
    }
    if (limits.exhausted_now()) return report;
    LevelCore levels;
    for (const AgentId i : model.instance().agent_ids())
      levels.push_back({i, report.lower_bound + 1});
    Verdict verdict = problem.solve({.below = std::move(levels)}, limits);
    if (verdict == Verdict::unknown) return report;
    if (verdict == Verdict::sat) {
      report.plan = problem.plan();
      report.end = SearchEnd::found;
      return report;
    }
    // All levels of a core are the same; as long as the next known thresholds of its agents make a
    // core too, the bound moves on to the smallest of them.
    ++statistics.cores;
    LevelCore core = problem.core();
    while (verdict == Verdict::unsat) {
      if (core.empty()) {
        report.end = SearchEnd::exhausted;
        return report;
      }
      Cost least = core.front().cost;
      for (const auto& level : core) least = std::min(least, level.cost);
      if (trace != nullptr && least > report.lower_bound)
        add_raise(*trace, least - report.lower_bound, core);
      report.lower_bound = std::max(report.lower_bound, least);
      problem.claim(least);
      LevelCore next;
      for (const auto& level : core)
        if (const auto threshold = problem.next_threshold(level.agent, report.lower_bound))
          next.push_back({level.agent, *threshold});
      verdict = problem.solve({.below = std::move(next), .search = Question::Search::known_clauses},
                              limits);
      core = problem.core();
    }
    if (verdict == Verdict::unknown) return report;
  }
}

}  // namespace quadrille::continuous
