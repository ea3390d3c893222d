// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "solve/desk.hpp"

namespace quadrille::continuous {

/// What a search for the least cost found.
struct CostReport {
  sat::SearchEnd end = sat::SearchEnd::stopped;
  Cost lower_bound = 0;      ///< Proven.
  std::optional<Plan> plan;  ///< The cheapest one found; of cost `lower_bound` if `end` is found.
};

/// Who hears of a cost search while it goes on, and tells it what others have found.
class Correspondent {
 public:
  virtual ~Correspondent() = default;
  /// The bound or the plan may be better. May stop the limits. Returns what others have found,
  /// which may be nothing.
  [[nodiscard]] virtual Message report(const CostReport& report) = 0;
  /// One of the levels is reached in every plan that is cheaper than the one reported last.
  virtual void report_core(const LevelCore& core) = 0;
  /// That no engine has counted.
  virtual void add_effort(Effort effort) = 0;
};

}  // namespace quadrille::continuous
