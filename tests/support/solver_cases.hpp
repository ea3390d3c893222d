// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "quadrille/discrete/solver.hpp"
#include "support/generators.hpp"
#include "support/joint_search.hpp"
#include "support/tuned_options.hpp"

namespace quadrille::discrete::support {

/// All systems, with the check schedules of the papers, for one objective.
[[nodiscard]] std::vector<TunedOptions> all_systems(Objective objective);
/// One set of options per system, with random schedules, seeds and self-checks.
[[nodiscard]] std::vector<TunedOptions> random_systems(Random& random, Objective objective);

/// What is wrong with a completed search: empty if its answer is `expected` and consistent in
/// itself.
[[nodiscard]] std::string find_fault(const Instance& instance, const TunedOptions& options,
                                     const SolveOutcome& outcome, const JointAnswer& expected);

/// The rules that every outcome obeys, whatever ended the search: bounds, plan, costs, no internal
/// error. Empty if it does.
[[nodiscard]] std::string find_inconsistency(const Instance& instance, const TunedOptions& options,
                                             const SolveOutcome& outcome);

/// Solves and compares. On a difference the instance is shrunk while it still differs from the
/// joint search; the text is a comment with the difference and a case for tests/regressions.
[[nodiscard]] std::string solve_and_compare(const Instance& instance, const TunedOptions& options,
                                            const JointAnswer& expected, const std::string& origin);

/// Greedily removes agents and vertices as long as `fails` stays true. Deterministic.
[[nodiscard]] Instance shrink(Instance instance, const std::function<bool(const Instance&)>& fails);

/// The instance without one agent.
[[nodiscard]] Instance without_agent(const Instance& instance, AgentId agent);

}  // namespace quadrille::discrete::support
