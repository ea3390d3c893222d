// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What a file with a plan says about it; nothing of it has been compared with the plan.
struct StatedOutcome {
  std::optional<Cost> sum_of_costs;
  std::optional<Cost> makespan;
  std::optional<Status> status;
  /// The lower bound, and of which cost.
  std::optional<Cost> lower_bound;
  std::optional<double> gap_percent;
  Objective objective = Objective::sum_of_costs;
};

/// The reverse of to_string; nullopt for other texts.
[[nodiscard]] std::optional<Objective> parse_objective(std::string_view text) noexcept;
[[nodiscard]] std::optional<Status> parse_status(std::string_view text) noexcept;

}  // namespace quadrille

QUADRILLE_API_END
