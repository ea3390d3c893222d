// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>

#include "quadrille/core/statistics.hpp"
#include "solve/cost_problem.hpp"

namespace quadrille::continuous {

/// What a search for the least cost found.
struct CostReport {
  sat::SearchEnd end = sat::SearchEnd::stopped;
  Cost lower_bound = 0;      ///< Proven.
  std::optional<Plan> plan;  ///< The cheapest one found; of cost `lower_bound` if `end` is found.
};

/// Hears of the bound and the plan, while the search goes on, each time that one may be better. It
/// may stop the limits.
using ReportListener = std::function<void(const CostReport&)>;

/// Finds a plan of least sum of costs by implicit hitting sets (Davies and Bacchus 2011, CP): the
/// cheapest costs that hit all known cores are the agents' caps; either there is a plan within
/// them, or there is a new core. The known plan is improved first; where cores are many, turns take
/// place that improve it again and try bounds on the sum of all costs. Integer costs may be as
/// large as they like. Ends by itself if the clauses allow no plan at all, which need not happen
/// where none exists. `some_plan`: one of any cost, if known. Plans that cost no more than `spared`
/// satisfy every clause that is made, even if a cheaper one is known. Deterministic as long as no
/// limit is met. Adds to `statistics.cores`.
[[nodiscard]] CostReport search_by_covers(CostProblem& problem, std::optional<Plan> some_plan,
                                          Cost spared, LimitMonitor& limits, Statistics& statistics,
                                          const ReportListener& on_report);

/// Finds a plan of least makespan from below: all agents are capped by the bound under test, and a
/// core moves it on to the next cost that one of its agents can have.
[[nodiscard]] CostReport search_makespan(CostProblem& problem, std::optional<Plan> some_plan,
                                         LimitMonitor& limits, Statistics& statistics,
                                         const ReportListener& on_report);

}  // namespace quadrille::continuous
