// SPDX-License-Identifier: MIT
#include "roadmap/execution_roadmap.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include "asked/execution_page.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/execution/clearance.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

struct Scene {
  continuous::Instance instance;
  continuous::Plan plan;
};

/// Keeps the scene that it looks at.
class RoadmapWatch : public ContactWatch {
 public:
  explicit RoadmapWatch(std::shared_ptr<const Scene> scene)
      : scene_(std::move(scene)), watch_(scene_->instance, scene_->plan) {}
  void add(std::span<const Ticks> before, std::span<const Ticks> after) override {
    watch_.add(before, after);
  }
  [[nodiscard]] std::size_t contacts() const override { return watch_.contacts().size(); }
  [[nodiscard]] std::optional<double> clearance() const override {
    if (!std::isfinite(watch_.least())) return std::nullopt;
    return watch_.least() * scene_->instance.resolution().length;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  execution::ClearanceWatch watch_;
};

}  // namespace

std::string check_execution_roadmap(const ExecutionArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::tasks);
  if (wrong.empty()) wrong = arguments.format.why_not_continuous("--plan-format");
  return wrong;
}

Result<ExecutionCase> load_execution_roadmap(const ExecutionArguments& arguments) {
  auto input = load_roadmap_input(arguments.roadmap, arguments.input);
  if (!input) return input.error();
  auto file = continuous::read_plan(std::filesystem::path(arguments.plan), input->instance,
                                    input->grid_or_null(), arguments.format.continuous);
  if (!file) return file.error();
  auto order = execution::precedences(input->instance, file->plan);
  if (!order) return order.error();
  const auto scene = std::make_shared<const Scene>(Scene{input->instance, std::move(file->plan)});
  ExecutionCase made{describe_input(*input),
                     std::move(order).value(),
                     input->instance.resolution().time,
                     false,
                     [](VertexId vertex) { return std::to_string(vertex.value()); },
                     [scene] { return std::make_unique<RoadmapWatch>(scene); }};
  add_page(std::make_shared<const input::RoadmapInput>(std::move(input).value()), 1, made);
  return made;
}

}  // namespace quadrille::cli
