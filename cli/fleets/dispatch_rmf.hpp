// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "fleets/dispatch_words.hpp"
#include "fleets/live_fleet.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::cli {

/// The dispatcher as a plan server of Open-RMF's next generation (docs/formats-of-others.md): goals
/// come in, plans and their releases go out. Progress is time of the robot's course.
class DispatchRmf {
 public:
  using Json = nlohmann::ordered_json;

  /// Keeps references to all.
  DispatchRmf(const LiveFleet& fleet, const DispatchWords& words);

  /// Those of a DestinationGoal that are the cheapest: of a robot that goes to it after what it has
  /// to do, alone, plus its cost_bias. Errors: syntax, invalid_instance.
  [[nodiscard]] Result<Goals> goals(const Json& goal, AgentId robot) const;
  /// The session of a goal that has been taken; all zero if it names none.
  void set_session(AgentId robot, const Json& goal);
  /// To be called after each call of the dispatcher: another course is another version of a plan.
  void note_courses();
  /// [{name, plan: Plan, release: PlanRelease, progress: Progress}].
  [[nodiscard]] Json messages() const;

 private:
  struct Known {
    Json session;
    std::int64_t version = 0;
    dispatch::Course course = {};
  };
  [[nodiscard]] Result<VertexId> vertex_of(const Json& constraints) const;
  /// By robot and move, the moves that others have to have made before.
  using Blockers = std::vector<std::vector<Json>>;
  [[nodiscard]] Blockers blockers() const;
  [[nodiscard]] Json plan(AgentId robot, const std::vector<Json>& blockers) const;
  [[nodiscard]] Json plan_id(AgentId robot) const;
  [[nodiscard]] Json waypoint(const dispatch::Course& course, std::size_t k) const;
  /// From the k-th stop to the next one.
  [[nodiscard]] Json trajectory(const dispatch::Course& course, std::size_t k) const;

  const LiveFleet& fleet_;
  const DispatchWords& words_;
  std::vector<Known> known_;  // by robot
};

}  // namespace quadrille::cli
