// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// How long a strategy may go on: one of both, or, if both are absent, until the limits are met.
struct Slice {
  std::optional<std::int64_t> conflicts = std::nullopt;  ///< Of those that ask an engine.
  std::optional<Effort> effort = std::nullopt;           ///< Of those that work on plans.
};

/// What a strategy came to.
enum class Outcome {
  working,    ///< The slice is over, or there is nothing to do at the moment.
  found,      ///< As SearchEnd::found.
  stopped,    ///< As SearchEnd::stopped.
  exhausted,  ///< As SearchEnd::exhausted.
};

/// One way to bring the bounds closer together. What it asks an engine for are bounds of costs, as
/// assumptions: what is learned stays true for all others.
class Strategy {
 public:
  virtual ~Strategy() = default;
  [[nodiscard]] virtual Outcome advance(Slice slice) = 0;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
