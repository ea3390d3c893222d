// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cover/level_cover.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/statistics.hpp"
#include "solve/cost_problem.hpp"
#include "solve/cost_report.hpp"

namespace quadrille::continuous {

/// A core as far as others depend on it: some of `agents` cost more in every plan in which those of
/// `ceilings` keep to theirs.
struct CoreUse {
  std::vector<AgentId> agents, ceilings;
};
/// What raised the bound, without bystanders, and all cores that were learned.
struct CostTrace {
  std::vector<Raise> raises;
  std::vector<CoreUse> cores;
};

/// What a search for the least sum of costs works with. References outlive it.
struct SumSearchContext {
  CostProblem& problem;
  const CostReport& known;  ///< A bound, and a plan of any cost if there is one.
  /// Plans that cost no more than this satisfy every clause that is made, even if a cheaper one is
  /// known.
  Cost spared = 0;
  Role role = Role::all;
  std::uint32_t seed = 0;
  LimitMonitor& limits;
  Statistics& statistics;  ///< Adds to `cores`.
  Correspondent& correspondent;
  /// To be tried before others: it need not be known that they are cores.
  std::span<const LevelCore> candidates;
  CostTrace* trace = nullptr;  ///< Filled in unless null, also when a limit is met.
  /// Likewise: what the bound of the last cover rests on.
  std::vector<ProvedCover>* covers = nullptr;
};

/// Finds a plan of least sum of costs by implicit hitting sets (Davies and Bacchus 2011, CP): the
/// cheapest costs that hit all known cores are the agents' caps; either there is a plan within
/// them, or there is a new core. The known plan is improved first, if there are no candidates to be
/// tried, because ceilings that follow from a dear plan let hardly anything be refuted; where cores
/// are many, turns take place that improve it again and try bounds on the sum of all costs. Beside
/// others it begins as its role says. Integer costs may be as large as they like. Ends by itself if
/// the clauses allow no plan at all, which need not happen where none exists. Deterministic as long
/// as no limit is met, and as the correspondent is.
[[nodiscard]] CostReport search_by_covers(const SumSearchContext& context);

}  // namespace quadrille::continuous
