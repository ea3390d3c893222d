// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/fleet.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::fleet {

/// continuous::Violation with names, metres and seconds.
struct Violation {
  continuous::Violation::Kind kind;
  AgentId robot;
  std::optional<AgentId> other;  ///< For collisions; larger than `robot`.
  Seconds time;                  ///< When the step begins in which it happens.
  std::string message;           ///< One sentence.
};

/// The free space between two robots over all time.
struct Clearance {
  AgentId robot;
  AgentId other;
  Metres gap;
  Seconds time;  ///< A moment at which it is that small.
};

struct VerifyReport {
  std::vector<Violation> violations;
  /// The least ones, as many as were asked for: continuous::VerifyReport.
  std::vector<Clearance> clearances;
  [[nodiscard]] bool valid() const noexcept { return violations.empty(); }
};

/// Replays a plan in whole units over all time, in exact arithmetic: continuous::verify, in the
/// words of the fleet. Errors: those of `fleet.instance()`.
[[nodiscard]] Result<VerifyReport> verify(const Fleet& fleet, const continuous::Plan& plan,
                                          std::size_t num_clearances = 1);

}  // namespace quadrille::fleet

QUADRILLE_API_END
