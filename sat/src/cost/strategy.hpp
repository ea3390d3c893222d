// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace quadrille::sat {

/// How long a strategy may go on.
struct Slice {
  std::optional<std::int64_t> conflicts;  ///< Absent: until the limits are met.
};

/// What a strategy came to.
enum class Outcome {
  working,    ///< The slice is over, or there is nothing to do at the moment.
  found,      ///< As SearchEnd::found.
  stopped,    ///< As SearchEnd::stopped.
  exhausted,  ///< As SearchEnd::exhausted.
};

/// One way to bring the bounds of a CostSearchContext closer together. What it asks the engine for
/// are bounds of costs, as assumptions: what is learned stays true for all others.
class Strategy {
 public:
  virtual ~Strategy() = default;
  [[nodiscard]] virtual Outcome advance(Slice slice) = 0;
};

}  // namespace quadrille::sat
