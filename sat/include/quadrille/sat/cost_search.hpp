// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/settings.hpp"
#include "quadrille/core/statistics.hpp"
#include "quadrille/sat/bounds.hpp"
#include "quadrille/sat/cost_problem.hpp"
#include "quadrille/sat/engine.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// The named place where a cost search lets everything else have its turn: improvement of plans,
/// progress, the test of the gap, other threads, the user. It is passed between two solves of the
/// engine, never inside of one.
class YieldPoint {
 public:
  virtual ~YieldPoint() = default;
  /// Called whenever the lower bound may have risen, and after each slice of a solve. May stop the
  /// limits.
  virtual void yield() = 0;
};

/// What a cost search works with. All outlive it.
struct CostSearchContext {
  Engine& engine;
  CostProblem& problem;
  Bounds& bounds;
  LimitMonitor& limits;
  YieldPoint& yield_point;
  const Settings& settings;
  /// Unless null, becomes the list of what raised the lower bound, whatever ends the search; no
  /// bystanders are named. Other bounds, such as those from above, are not in it.
  std::vector<Raise>* raises = nullptr;
  /// Of the order in which what a core does not need is dropped. 0: the order of the assumptions.
  std::uint32_t seed = 0;
};

/// How a cost search ended.
enum class SearchEnd {
  found,      ///< The plan accepted last costs `Bounds::lower`, which is optimal.
  stopped,    ///< A limit, or the incumbent that is proved optimal, ended the search.
  exhausted,  ///< The clauses allow no plan, whatever its cost.
};

/// Tries the bounds lb, lb+1, ... until a plan is found: the search of MDD-SAT and SMT-CBS (Surynek
/// et al. 2016, ECAI; Surynek 2019, IJCAI). Never ends by itself if no plan exists.
[[nodiscard]] SearchEnd search_upwards(CostSearchContext context);

/// Of the core-guided search: what a problem allows. The numbers are settings.
struct CoreGuidedOptions {
  /// Look for plans from above too, once cores take long. Only for problems that need no growth,
  /// with an engine that records its clauses for this search alone.
  bool from_above = false;
  /// Try to raise the bound by more than one for a core. Only for problems that need no growth.
  bool raise_cores = false;
};

/// Finds a plan of least sum of costs from below: assumes that nobody costs more than its share of
/// the lower bound, and relaxes the bounds that a core names by one unit in all, or by several
/// where that is refuted as well (OLL: Andres et al. 2012, ICLP; Morgado et al. 2014, CP). When a
/// core is hard, it starts again, and goes on from the best of its passes. With `from_above` and
/// hard cores after that it takes turns with a search from above, which asks for plans that are
/// cheaper than the incumbent by a bound on the sum of what the cores have left open (core-boosted
/// search: Berg et al. 2019, CPAIOR). Never ends by itself if no plan exists. Deterministic as long
/// as no limit is met. Adds to `statistics.cores`.
[[nodiscard]] SearchEnd search_by_cores(CostSearchContext context, const CoreGuidedOptions& options,
                                        Statistics& statistics);

}  // namespace quadrille::sat

QUADRILLE_API_END
