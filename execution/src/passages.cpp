// SPDX-License-Identifier: MIT
#include "passages.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "quadrille/execution/executor.hpp"

namespace quadrille::execution {
namespace {

constexpr std::size_t kMostNamed = 4;

bool has_passages(const Precedences& order) {
  return std::ranges::any_of(order.moves, [](const std::vector<TimedMove>& moves) {
    return std::ranges::any_of(moves, &TimedMove::goes_on);
  });
}

/// Where agents are that nothing delays and that can go on no further.
std::vector<Ticks> last_clocks(const Precedences& order) {
  Executor executor(order);
  std::vector<Ticks> clocks(order.num_agents(), order.now), targets;
  for (bool goes_on = true; goes_on; clocks.swap(targets)) {
    targets.clear();
    for (const AgentId agent : IdRange<AgentId>(order.num_agents()))
      targets.push_back(order.end(agent));
    executor.couple(clocks, targets);
    goes_on = targets != clocks;
  }
  return clocks;
}

}  // namespace

std::optional<Error> why_passages_block(const Precedences& order) {
  if (!has_passages(order)) return std::nullopt;
  const std::vector<Ticks> clocks = last_clocks(order);
  std::string who;
  std::size_t num_blocked = 0;
  for (const AgentId agent : IdRange<AgentId>(order.num_agents())) {
    const auto& moves = order.moves[agent];
    const auto next = std::ranges::find_if(
        moves, [&](const TimedMove& move) { return move.end > clocks[agent.index()]; });
    if (next == moves.end()) continue;
    // Others stand behind these.
    if (!next->goes_on || clocks[agent.index()] != next->begin) continue;
    if (++num_blocked <= kMostNamed)
      who += (num_blocked == 1 ? "" : ", ") + ("agent " + std::to_string(agent.value())) +
             " at vertex " + std::to_string(next->from.value()) + " before vertex " +
             std::to_string(next->to.value());
  }
  if (num_blocked == 0) return std::nullopt;
  if (num_blocked > kMostNamed) who += " and others";
  return Error{ErrorCode::invalid_plan,
               "where nobody may wait, agents go through at once, and so they would wait for each "
               "other for ever: " +
                   who,
               {}};
}

}  // namespace quadrille::execution
