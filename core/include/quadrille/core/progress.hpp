// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What a solve is doing. No solve comes to all of them; on graphs feasibility is first.
enum class Phase : std::uint8_t {
  set_up,        ///< How far the goals are, and what moving obstacles forbid.
  joint_search,  ///< A small instance: joint positions of all agents (continuous time).
  routes,        ///< Few agents: orders along whole routes (continuous time).
  first_plan,    ///< Some plan, whatever it costs.
  feasibility,   ///< Whether there is any plan.
  search,        ///< Raises the lower bound and makes plans cheaper.
};
[[nodiscard]] std::string_view to_string(
    Phase phase) noexcept;  ///< "set-up" | "joint-search" | ...

/// A look at a running solve. Costs are timesteps or ticks.
struct Progress {
  Phase phase = Phase::set_up;
  Cost lower_bound = 0;
  std::optional<Cost> cost;  ///< Of the best plan so far.
  double elapsed_s = 0;
  std::int64_t conflicts = 0;
};

}  // namespace quadrille

QUADRILLE_API_END
