// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "quadrille/discrete/primal.hpp"

namespace quadrille::discrete {

/// PrimalSearch with restarts. How long it takes to find a plan on a crowded map has a heavy tail
/// over the seeds: most find one at once, some not in a thousand times as long (see Gomes et al.,
/// "Heavy-tailed phenomena in satisfiability and constraint satisfaction problems", JAR 2000). The
/// search with the seed itself goes on for ever, which keeps all complete; once it takes long, it
/// takes turns with searches of other seeds, each with an effort of its own that follows the
/// sequence of Luby et al. ("Optimal speedup of Las Vegas algorithms", IPL 1993). These are
/// forgotten when they end, so that at most two are in memory.
class RestartedSearch {
 public:
  using State = PrimalSearch::State;

  /// `instance` outlives the object; `distances` are its own.
  RestartedSearch(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                  std::uint32_t seed);

  /// As PrimalSearch::advance. What is found depends on the efforts that were asked for.
  State advance(std::int64_t effort, LimitMonitor& limits);
  /// Trimmed. Requires that one was found.
  [[nodiscard]] Plan plan() const;

 private:
  State advance_other(std::int64_t effort, LimitMonitor& limits);

  const Instance& instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  const std::uint32_t seed_;
  std::int64_t unit_;  // The effort of most searches.
  PrimalSearch main_;
  std::optional<PrimalSearch> other_;
  std::uint32_t num_others_ = 0;
};

/// The k-th number of 1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8, ... Requires k >= 1.
[[nodiscard]] std::int64_t luby(std::uint32_t k);

}  // namespace quadrille::discrete
