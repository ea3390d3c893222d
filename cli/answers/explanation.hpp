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

/// That an agent with several goals does not end at the nearest one: who does, if anybody.
struct FartherGoal {
  AgentId agent;
  VertexId end, nearest;
  Cost farther = 0;  ///< Than that one, each if the agent is alone.
  std::optional<AgentId> owner;
};
/// Of all agents for whom that is so. `end(i)`: where the agent ends; `cost_to(i, goal)`: of its
/// way there if it is alone; nullopt if there is none.
template <class Instance, class End, class CostTo>
[[nodiscard]] std::vector<FartherGoal> find_farther_goals(const Instance& instance, const End& end,
                                                          const CostTo& cost_to) {
  std::vector<FartherGoal> found;
  for (const AgentId i : instance.agent_ids()) {
    const VertexId own = end(i);
    const std::optional<Cost> cost = cost_to(i, own);
    FartherGoal farther{i, own, own, 0, std::nullopt};
    for (const VertexId goal : instance.agents()[i].goals.vertices())
      if (const auto other = cost_to(i, goal); cost && other && *cost - *other > farther.farther) {
        farther.nearest = goal;
        farther.farther = *cost - *other;
      }
    if (farther.farther == 0) continue;
    for (const AgentId j : instance.agent_ids())
      if (j != i && end(j) == farther.nearest && !farther.owner) farther.owner = j;
    found.push_back(farther);
  }
  return found;
}
/// A line for each of the first ones; none if there are none.
[[nodiscard]] std::string describe_farther_goals(const std::vector<FartherGoal>& goals,
                                                 const Names& names);

/// The keys "attribution" and "reasons" of a result, documented in docs/formats.md.
void add_explanation(ResultJson& result, const std::optional<Attribution>& attribution,
                     const std::vector<Reason>& reasons, const Names& names);

}  // namespace quadrille::cli
