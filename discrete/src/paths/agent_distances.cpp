// SPDX-License-Identifier: MIT
#include "paths/agent_distances.hpp"

namespace quadrille::discrete {

AgentDistances::AgentDistances(const Instance& instance, const GoalDistances& table, AgentId agent,
                               const GoalPrices* prices)
    : graph_(&instance.graph()),
      table_(&table),
      task_(instance.agents()[agent]),
      to_goal_(table.row(agent)),
      prices_(prices) {
  QUADRILLE_REQUIRE(free_cost() != kUnreachable, "a goal is reachable");
}

void AgentDistances::find_from_start() const {
  from_start_ = table_->pack(distances_from(*graph_, task_.start));
}

}  // namespace quadrille::discrete
