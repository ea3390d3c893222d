// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::execution::test {

struct ContinuousCase {
  continuous::Instance instance;
  continuous::Plan plan;
};
struct DiscreteCase {
  discrete::Instance instance;
  discrete::Plan plan;
};

/// A random roadmap of few units, on which roads cross and bodies overlap, with the first plan that
/// is found; nothing where there is none. `agents` 2 to 8.
[[nodiscard]] std::optional<ContinuousCase> continuous_case(std::uint32_t seed, std::size_t agents);
/// The same with vertices where nobody may wait.
[[nodiscard]] std::optional<ContinuousCase> passing_case(std::uint32_t seed, std::size_t agents);
/// A crowded little grid with the first plan that is found.
[[nodiscard]] std::optional<DiscreteCase> discrete_case(std::uint64_t seed);
/// The same with agents that leave at their goals, some of them at those of others, and releases.
[[nodiscard]] std::optional<DiscreteCase> leaving_case(std::uint64_t seed);

}  // namespace quadrille::execution::test
