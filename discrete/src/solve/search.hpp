// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "certificate/certify.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solve/desk.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// Null when a limit was met.
using GetDistances = std::function<std::shared_ptr<const GoalDistances>(LimitMonitor&)>;

/// One search: goal distances, a first plan, the search for the least cost. Requires an instance
/// that has a plan. Leaves at `desk` what it finds, whatever ends it, and, with
/// SolveOptions::proof, in `proof` why no plan is cheaper.
void search(const Instance& instance, const SolveOptions& options, const Tuning& tuning,
            const Desk& desk, const GetDistances& get_distances, ProofDraft& proof);

}  // namespace quadrille::discrete
