// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// What is known of the least cost, from both sides: the proven lower bound and the incumbent, the
/// cheapest plan that anybody has found. The plan itself is kept by who knows what plans are.
class Bounds {
 public:
  virtual ~Bounds() = default;

  /// No plan is cheaper.
  [[nodiscard]] Cost lower() const noexcept { return lower_; }
  /// Never lowers it.
  void raise(Cost lower) noexcept { lower_ = std::max(lower_, lower); }

  /// Cost of the incumbent; nullopt if there is none.
  [[nodiscard]] virtual std::optional<Cost> upper() const = 0;
  /// What an agent costs in the incumbent. Requires one.
  [[nodiscard]] virtual Cost incumbent_cost_of(AgentId agent) const = 0;
  /// Called for each model that the problem has accepted: its plan becomes the incumbent if it is
  /// cheaper.
  virtual void offer_accepted() = 0;

  /// The incumbent is optimal.
  [[nodiscard]] bool are_closed() const { return upper() == lower_; }

 private:
  Cost lower_ = 0;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
