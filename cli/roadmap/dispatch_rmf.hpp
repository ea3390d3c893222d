// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/dispatcher.hpp"
#include "roadmap/dispatch_words.hpp"

namespace quadrille::cli {

/// The dispatcher as a plan server of Open-RMF's next generation (docs/formats-of-others.md): goals
/// come in, plans and their releases go out. Progress is time of the robot's course.
class DispatchRmf {
 public:
  using Json = nlohmann::ordered_json;

  /// Keeps references to all.
  DispatchRmf(const continuous::Instance& instance, const DispatchWords& words,
              const dispatch::Dispatcher& dispatcher);

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
  [[nodiscard]] Json plan(AgentId robot) const;
  [[nodiscard]] Json plan_id(AgentId robot) const;
  [[nodiscard]] Json waypoint(const dispatch::Course& course, std::size_t k) const;

  const continuous::Instance& instance_;
  const DispatchWords& words_;
  const dispatch::Dispatcher& dispatcher_;
  std::vector<Known> known_;  // by robot
};

}  // namespace quadrille::cli
