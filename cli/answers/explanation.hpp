// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answers/report.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/reasons.hpp"

namespace quadrille::cli {

/// How a domain names what an attribution speaks of.
struct Names {
  std::function<std::string(VertexId)> vertex;  ///< "(3, 4)"
  std::function<Json(VertexId)> vertex_json;
  std::function<std::string(Cost)> cost;  ///< A cost or a time.
  bool has_timesteps = true;              ///< Else moments.
};

/// Of the search for reasons: conflicts of each search for a few agents alone, and how many
/// searches there are for one reason; places shown.
inline constexpr std::int64_t kRecheckConflicts = 3000;
inline constexpr std::size_t kMaxRechecks = 100;
inline constexpr std::size_t kMaxSites = 2;

/// What is left of limits, of which the wall and CPU times began when this was made: before the
/// first search.
class RemainingLimits {
 public:
  explicit RemainingLimits(const Limits& limits) : limits_(limits) {}
  /// For one more search of at most `conflicts`; nullopt: no time is left.
  [[nodiscard]] std::optional<Limits> next(std::int64_t conflicts) const;

 private:
  const Limits limits_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// "agent 3", "agents 3 and 7", "agents 3, 7 and 9".
[[nodiscard]] std::string list_agents(const std::vector<AgentId>& agents);

/// The lines "bound" and "because" of the human output: what the lower bound is made of, reason by
/// reason, each with a number from 1 on and with at most `max_sites` places.
[[nodiscard]] std::string describe_attribution(const Attribution& attribution,
                                               const std::vector<Reason>& reasons,
                                               const Names& names, std::size_t max_sites);

/// The keys "attribution" and "reasons" of a result, documented in docs/formats.md.
void add_explanation(ResultJson& result, const std::optional<Attribution>& attribution,
                     const std::vector<Reason>& reasons, const Names& names);

}  // namespace quadrille::cli
