// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "feasibility/goal_reach.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/sat/certificate.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/engine.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// The models, theory and engine of one search, wired up as its system asks.
class Run {
 public:
  virtual ~Run() = default;
  /// To be called once, first. Null unless there are prices: then the distances are theirs, and the
  /// costs of the problem include them. False if `limits` ended that early.
  [[nodiscard]] virtual bool prepare(std::shared_ptr<const GoalDistances> distances,
                                     const PricedGoals* priced, LimitMonitor& limits) = 0;
  [[nodiscard]] virtual sat::Engine& engine() = 0;
  [[nodiscard]] virtual const sat::Engine& engine() const = 0;
  [[nodiscard]] virtual sat::CostProblem& problem() = 0;
  /// Of the models with MDDs: the plans that cost at most `cost`, which some plan does, by how many
  /// moves they have. It is used in the place of `problem`, and dies before the run. Otherwise
  /// null.
  [[nodiscard]] virtual std::unique_ptr<sat::CostProblem> fewest_moves(Cost /*cost*/) {
    return nullptr;
  }
  [[nodiscard]] virtual const Plan& plan() const = 0;
  /// The paths that the search had at the end of its last slice, or has now if there was none; they
  /// may collide. Empty if the model has no paths.
  [[nodiscard]] virtual Plan draft() const { return {}; }
  [[nodiscard]] virtual std::int64_t num_checks() const = 0;
  [[nodiscard]] virtual std::int64_t num_rejected() const = 0;
  [[nodiscard]] virtual std::optional<std::string> complaint() const = 0;
  /// What its lower bound rests on. Requires SolveOptions::proof. Errors: internal.
  [[nodiscard]] virtual Result<sat::TrimmedProof> proof() const = 0;
  /// Adds the raises, with their bystanders, and the sites. Requires SolveOptions::explain.
  virtual void explain(std::vector<Raise> /*raises*/, Attribution& /*attribution*/) const {}
};

/// `instance` and `options` outlive the run.
[[nodiscard]] std::unique_ptr<Run> make_run(const Instance& instance, const SolveOptions& options,
                                            const Tuning& tuning);

}  // namespace quadrille::discrete
