// SPDX-License-Identifier: MIT
#include "unheeded.hpp"

#include "open_task.hpp"

namespace quadrille::dispatch {
namespace {

std::optional<Error> refuse_rules(const continuous::Instance& instance) {
  for (const AgentId i : instance.agent_ids()) {
    const continuous::Agent& agent = instance.agent(i);
    if (instance.roadmap().lane_place(agent.start) != nullptr)
      return invalid(robot_name(i) +
                     " begins in the middle of a move, which is not supported here: robots begin "
                     "at vertices");
    if (agent.release > 0)
      return invalid(robot_name(i) +
                     " is released later, which is not supported here: assign its task then");
    if (agent.leaves)
      return invalid(robot_name(i) +
                     " leaves at its goal, which is not supported here: robots stay in the fleet");
  }
  if (instance.parked_pairs().empty()) return std::nullopt;
  const auto& [one, other] = instance.parked_pairs().front();
  return invalid(robot_name(one) + " and " + robot_name(other) +
                 " overlap at their starts, which is not supported here");
}

}  // namespace

std::optional<Error> refuse_unheeded(const continuous::Instance& instance) {
  if (instance.now() != 0) return invalid("a live fleet begins at time 0");
  if (!instance.obstacles().empty())
    return invalid("moving obstacles are not supported here: they wait for nobody");
  if (instance.has_whole_moves())
    return invalid(
        "plans for whole moves are not supported here: robots wait within lanes, where their "
        "limits are");
  if (instance.roadmap().num_vertices() < 2)
    return invalid("there has to be somewhere to go: two vertices");
  if (instance.has_shapes())
    return invalid(
        "bodies that change on the way are not supported here: take the discs around them");
  if (!instance.roadmap().no_waiting().empty())
    return invalid("places where nobody may wait are not supported here: who is late waits");
  return refuse_rules(instance);
}

}  // namespace quadrille::dispatch
