// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "cost/candidate_search.hpp"
#include "cost/cost_neighbourhoods.hpp"
#include "cost/excess_counter.hpp"
#include "cost/relaxation.hpp"
#include "cost/sum_descent.hpp"
#include "engine/offline_solver.hpp"
#include "quadrille/sat/strategy.hpp"

namespace quadrille::sat {

/// The search from above of a core-guided search (core-boosted linear search: Berg et al. 2019,
/// CPAIOR): bounds the sum of what the cores found so far leave open. First neighbourhoods of the
/// incumbent, then candidates if the bounds are close, or else all plans.
class SearchFromAbove final : public Strategy {
 public:
  /// All outlive it; the relaxation is what the cores have come to, see `rebase`.
  explicit SearchFromAbove(const CostSearchContext& context)
      : context_(context), offline_(context.engine) {}

  /// To be called before each slice: counts from `relaxation` when that has come much farther than
  /// what it counts from now.
  void rebase(const Relaxation& relaxation);
  [[nodiscard]] Outcome advance(Slice slice) override;
  void add_statistics(Statistics& statistics) const { offline_.add_statistics(statistics); }

 private:
  /// What shares a counter.
  struct Parts {
    Parts(const CostSearchContext& context, OfflineSolver& offline, const Relaxation& relaxation)
        : counter(context.engine, relaxation.bound(), relaxation.num_softs(), relaxation.excess()),
          neighbourhoods(context, counter),
          sum_descent(context, counter),
          candidates(context, offline, counter) {}
    ExcessCounter counter;
    CostNeighbourhoods neighbourhoods;
    SumDescent sum_descent;
    CandidateSearch candidates;
  };

  const CostSearchContext context_;
  OfflineSolver offline_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::sat
