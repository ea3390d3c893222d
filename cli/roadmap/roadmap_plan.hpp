// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "asked/given_plan.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// The plan of a command, and the instance that it is for: where the options name a roadmap and no
/// agents, the plan says where they begin and end.
class RoadmapPlan {
 public:
  /// Keeps references to the options. `format`: absent if the file says it.
  RoadmapPlan(const input::RoadmapOptions& options, const input::InputOptions& input,
              std::string file, std::optional<continuous::PlanFormat> format)
      : options_(options), input_(input), plan_(std::move(file)), format_(format) {}

  /// Errors: those of load_roadmap_input; without agents also those of `read` and with_agents_of,
  /// and invalid_plan for a log of CCBS, which needs them.
  [[nodiscard]] Result<input::RoadmapInput> load();
  /// Errors: those of continuous::read_plan.
  [[nodiscard]] Result<continuous::PlanFile> read(const input::RoadmapInput& input);
  /// Of the file.
  [[nodiscard]] const Result<std::string>& text() { return plan_.text(); }

 private:
  const input::RoadmapOptions& options_;
  const input::InputOptions& input_;
  GivenPlan plan_;
  std::optional<continuous::PlanFormat> format_;
};

}  // namespace quadrille::cli
