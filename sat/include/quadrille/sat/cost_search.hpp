// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/sat/engine.hpp"

namespace quadrille::sat {

/// A problem whose plans are the models of an engine's clauses, bounded in cost by assumptions.
class BoundedProblem {
 public:
  virtual ~BoundedProblem() = default;
  /// No plan is cheaper.
  [[nodiscard]] virtual Cost lower_bound() const = 0;
  /// Appends assumptions that hold only in plans that cost at most `bound`, after adding the
  /// clauses that such plans need. They may be stronger than that at first: `next_bound` weakens
  /// them. Retracts nothing. False if `limits` ended that early.
  [[nodiscard]] virtual bool assume_at_most(Cost bound, LimitMonitor& limits,
                                            std::vector<Lit>& assumptions) = 0;
  /// Looks at the engine's model. False: it is no plan, clauses that exclude it were added.
  [[nodiscard]] virtual bool accept_model() = 0;
  /// The assumptions in `core`, some of those for `bound`, cannot hold together. Returns a larger
  /// bound that no plan is below; or `bound` itself if the core only shows that the assumptions
  /// were stronger than need be, and the next ones for `bound` will be weaker.
  [[nodiscard]] virtual Cost next_bound(Cost bound, std::span<const Lit> core) = 0;
};

struct SearchReport {
  enum class End {
    found,      ///< The accepted model costs `lower_bound`, which is optimal.
    stopped,    ///< A limit, or another plan that is proved optimal, ended the search.
    exhausted,  ///< The clauses allow no plan, whatever its cost.
  };
  End end = End::stopped;
  Cost lower_bound = 0;  ///< Proven.
};

/// Called between SAT calls with the bound under test.
using BoundListener = std::function<void(Cost bound)>;

/// Tries the bounds lb, lb+1, ... until a plan is found: the search of MDD-SAT and SMT-CBS (Surynek
/// et al. 2016, ECAI; Surynek 2019, IJCAI). Never ends by itself if no plan exists.
[[nodiscard]] SearchReport search_upwards(Engine& engine, BoundedProblem& problem,
                                          LimitMonitor& limits, const BoundListener& on_bound);

}  // namespace quadrille::sat
