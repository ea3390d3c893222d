// SPDX-License-Identifier: MIT
#include "campaign/answers/replay.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "campaign/run/plan_text.hpp"
#include "frame/input_options.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/input/grid.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli::campaign {
namespace {

/// What a replay says against the row's cost.
template <class Report>
std::optional<std::string> judge(const Job& job, const Row& row, const Report& report) {
  if (!report.valid())
    return fmt::format("its plan is not valid: {}", report.violations.front().message);
  const Cost cost = job.objective == Objective::makespan ? report.makespan : report.sum_of_costs;
  if (!row.exact_cost || *row.exact_cost != cost)
    return fmt::format("it says that its plan costs {}, and it costs {}",
                       row.exact_cost ? std::to_string(*row.exact_cost) : "nothing", cost);
  return std::nullopt;
}

}  // namespace

struct Replayer::Loaded {
  std::vector<std::string> words;
  std::optional<input::GridInput> grid;
  std::optional<input::RoadmapInput> roadmap;
};

Replayer::Replayer() = default;
Replayer::~Replayer() = default;

/// Reads the instance as `solve` does.
std::optional<std::string> Replayer::load(const Job& job) {
  if (loaded_ && loaded_->words == job.instance) return std::nullopt;
  loaded_ = std::make_unique<Loaded>();
  CLI::App app;
  InputOptions input;
  RoadmapOptions roadmap;
  add_input_options(app, input);
  add_roadmap_options(app, roadmap);
  std::vector<std::string> words(job.instance.rbegin(), job.instance.rend());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return std::string("its instance: ") + error.what();
  }
  if (is_roadmap(input, roadmap)) {
    auto read = load_roadmap_input(roadmap, input);
    if (!read) return "its instance: " + read.error().to_string();
    loaded_->roadmap = *std::move(read);
  } else {
    auto read = load_grid_input(input);
    if (!read) return "its instance: " + read.error().to_string();
    loaded_->grid = *std::move(read);
  }
  loaded_->words = job.instance;
  return std::nullopt;
}

std::optional<std::string> Replayer::check_grid(const Job& job, const Row& row) const {
  const discrete::Instance& instance = loaded_->grid->instance;
  discrete::Plan plan;
  if (row.plan.is_array()) {
    if (!instance.graph().layout()) return "its plan is one for a grid";
    for (const auto& path : row.plan) {
      auto decoded =
          path.is_string() ? decode_path(instance.graph(), path.get<std::string>()) : std::nullopt;
      if (!decoded) return "its plan leaves the grid";
      plan.paths.push_back(*std::move(decoded));
    }
  } else {
    std::istringstream in(row.plan.dump());
    auto file = discrete::read_plan(in, "its plan", instance.graph(), discrete::PlanFormat::json);
    if (!file) return file.error().to_string();
    plan = std::move(file.value().plan);
  }
  return judge(job, row, discrete::verify(instance, plan));
}

std::optional<std::string> Replayer::check_roadmap(const Job& job, const Row& row) const {
  const continuous::Instance& instance = loaded_->roadmap->instance;
  std::istringstream in(row.plan.dump());
  const auto file = continuous::read_plan(
      in, "its plan", instance, loaded_->roadmap->grid_or_null(), continuous::PlanFormat::json);
  if (!file) return file.error().to_string();
  return judge(job, row, continuous::verify(instance, file->plan));
}

std::optional<std::string> Replayer::check(const Job& job, const Row& row) {
  if (row.plan.is_null()) {
    if (row.exact_cost) return "it states a cost, and has no plan";
    return std::nullopt;
  }
  if (auto wrong = load(job)) return wrong;
  return loaded_->roadmap ? check_roadmap(job, row) : check_grid(job, row);
}

}  // namespace quadrille::cli::campaign
