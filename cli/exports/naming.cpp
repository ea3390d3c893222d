// SPDX-License-Identifier: MIT
#include "exports/naming.hpp"

#include <fmt/format.h>

#include <map>

#include "quadrille/text/text_input.hpp"

namespace quadrille::cli {

Result<RobotNames> robot_names(const text::Names& names, std::size_t num_agents) {
  RobotNames robots;
  std::map<std::string, AgentId> known;
  for (const AgentId agent : IdRange<AgentId>(num_agents)) {
    const std::string* const given = names.agent(agent.index());
    robots.push_back(given != nullptr ? *given : fmt::format("agent{}", agent.value()));
    const auto [other, is_new] = known.emplace(robots[agent], agent);
    if (!is_new)
      return Error{ErrorCode::invalid_instance,
                   fmt::format("agents {} and {} are both called {}", other->second.value(),
                               agent.value(), text::in_quotes(robots[agent])),
                   {}};
  }
  return robots;
}

}  // namespace quadrille::cli
