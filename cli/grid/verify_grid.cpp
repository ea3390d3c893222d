// SPDX-License-Identifier: MIT
#include "grid/verify_grid.hpp"

#include <filesystem>
#include <string>

#include "frame/arguments.hpp"
#include "grid/grid_report.hpp"
#include "grid/grid_text.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/input/called.hpp"
#include "quadrille/input/grid.hpp"

namespace quadrille::cli {
namespace {

class GridVerdict {
 public:
  GridVerdict(const input::GridInput& input, const discrete::Plan& plan,
              const discrete::VerifyReport& replay)
      : input_(input), plan_(plan), replay_(replay) {}

  [[nodiscard]] std::string describe_input() const { return cli::describe_input(input_); }
  [[nodiscard]] std::string good() const { return describe_check(plan_, replay_); }
  [[nodiscard]] std::string more() const { return ""; }
  [[nodiscard]] Json cost_json(Cost cost) const { return cost; }
  [[nodiscard]] Called called() const { return input::called(input_.names); }
  void add_measures(JsonLines&) const {}
  [[nodiscard]] Json violation_json(const discrete::Violation& violation) const {
    const discrete::Graph& graph = input_.instance.graph();
    Json json;
    json["kind"] = to_string(violation.kind);
    json["agents"] = Json::array();
    if (violation.kind != discrete::Violation::Kind::path_count)
      json["agents"].push_back(violation.agent.index());
    if (violation.other) json["agents"].push_back(violation.other->index());
    if (graph.layout() && violation.vertex.index() < graph.num_vertices()) {
      const auto [x, y] = graph.layout()->cell_of(violation.vertex);
      json["at"] = {x, y};
    } else {
      json["at"] = violation.vertex.index();
    }
    json["timestep"] = violation.timestep;
    return json;
  }

 private:
  const input::GridInput& input_;
  const discrete::Plan& plan_;
  const discrete::VerifyReport& replay_;
};

}  // namespace

ExitCode verify_grid(const CLI::App& app, const VerifyArguments& arguments) {
  std::string wrong = why_no_roadmap(arguments.roadmap);
  if (wrong.empty()) wrong = check_grid_options(arguments.input, Need::plan);
  if (wrong.empty()) wrong = arguments.format.why_not_discrete("--plan-format");
  if (wrong.empty() && arguments.check_with) wrong = "--check-with applies to roadmaps only";
  if (wrong.empty()) wrong = check_verify_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  auto input = load_grid_input(arguments.input);
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const std::filesystem::path path(arguments.plan);
  const bool is_alone = is_map_alone(arguments.input);
  const auto file =
      is_alone ? discrete::read_plan(path, input->instance.graph(), arguments.format.discrete)
               : discrete::read_plan(path, input->instance, arguments.format.discrete);
  if (file && is_alone) input = with_agents_of(*std::move(input), file->plan, arguments.plan);
  if (!file || !input) {
    report_error(file ? input.error() : file.error());
    return ExitCode::bad_input;
  }
  const auto replay = verify(input->instance, file->plan);
  return pronounce(arguments, GridVerdict(*input, file->plan, replay), *file, replay);
}

}  // namespace quadrille::cli
