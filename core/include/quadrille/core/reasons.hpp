// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// A part of the answer to "why is it this expensive?": these agents alone, as if there were no
/// others, cost this much more than their free costs (makespan: have this bound).
struct Reason {
  std::vector<AgentId> agents;  ///< Increasing.
  Cost amount = 0;              ///< Above the sum of their free costs (makespan: the free bound).
  /// Shown again by a search of these agents alone. Otherwise the attribution says so.
  bool is_checked = false;
  /// Where they are in each other's way, most lemmas first: places in Attribution::sites.
  std::vector<std::size_t> sites;
};

/// Finds out what some agents, increasing, cost at least when there are no others; nullopt: not
/// known. Any valid lower bound will do.
using Recheck = std::function<std::optional<Cost>(const std::vector<AgentId>& agents)>;

/// Reasons whose amounts sum up to what the lower bound is above the free bound, about as few
/// agents each as are found; the makespan has one. Agents that share raises, directly or not, are
/// one reason at first. With `recheck`, which may be empty, it is divided into pairs if those
/// amount to as much, or else agents are left out one by one while the rest amounts to as much. At
/// most `max_checks` calls for each.
[[nodiscard]] std::vector<Reason> find_reasons(const Attribution& attribution,
                                               const Recheck& recheck,
                                               std::size_t max_checks = 200);

}  // namespace quadrille

QUADRILLE_API_END
