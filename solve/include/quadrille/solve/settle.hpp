// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::solve {

/// Proved: there is no plan.
struct Infeasibility {
  std::string why;
  // As in Outcome.
  std::vector<AgentId> blocked = {};
  std::vector<VertexId> bottleneck = {};
};

/// What is known of the least cost, and what ended the search: all that an outcome depends on.
struct Facts {
  Cost floor = 0;                  ///< Proved, whatever the user claims.
  Cost claimed = 0;                ///< The user says that no plan costs less.
  Cost raised = 0;                 ///< Proved by searches that began from the claim.
  std::optional<Cost> cost = {};   ///< Of the cheapest plan.
  std::optional<Cost> given = {};  ///< Of a plan that the user gave, valid.
  std::optional<Infeasibility> infeasible = {};
  StopReason stop = StopReason::none;
  /// Why a search ended with neither a proof nor a reason to stop.
  std::string why_open = {};
  std::optional<Error> error = {};

  /// No plan costs less, by all that is known or claimed.
  [[nodiscard]] Cost lower() const noexcept { return std::max({floor, claimed, raised}); }
  /// No plan that is known costs less than the user claims.
  [[nodiscard]] bool is_claim_refuted() const noexcept {
    return (cost && *cost < claimed) || (given && *given < claimed);
  }
};

/// The error (out_of_range) for a lower bound that a user claims to know, if a valid plan costs
/// `cost`, in timesteps or ticks, and that is less.
[[nodiscard]] std::optional<Error> refuse_bound(Cost claimed, Cost cost);

/// What an outcome says besides the plan and the bound. There is a plan for optimal and feasible.
struct Settlement {
  Status status = Status::unknown;
  StopReason stop = StopReason::none;
  std::string explanation = {};
  bool rests_on_claim = false;
  /// Of the code out_of_range: the claim is wrong, which is an error of the input. Else an internal
  /// one.
  std::optional<Error> error = {};
};

/// The decision table of docs/cli.md, in both domains. Pure.
[[nodiscard]] Settlement settle(Facts facts, std::optional<double> wanted_gap);
/// Whether nothing more is to be done. Takes no memory.
[[nodiscard]] bool is_proof(const Facts& facts, std::optional<double> wanted_gap) noexcept;

}  // namespace quadrille::solve

QUADRILLE_API_END
