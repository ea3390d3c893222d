// SPDX-License-Identifier: MIT
#include "roadmap/verify_roadmap.hpp"

#include <optional>
#include <string>

#include "frame/arguments.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/input/called.hpp"
#include "roadmap/opinion_report.hpp"
#include "roadmap/roadmap_plan.hpp"
#include "roadmap/roadmap_report.hpp"
#include "roadmap/roadmap_text.hpp"

namespace quadrille::cli {
namespace {

class RoadmapVerdict {
 public:
  RoadmapVerdict(const input::RoadmapInput& input, const continuous::VerifyReport& replay,
                 const std::optional<continuous::SecondOpinion>& opinion)
      : input_(input), replay_(replay), opinion_(opinion) {}

  [[nodiscard]] std::string describe_input() const { return cli::describe_input(input_); }
  [[nodiscard]] std::string good() const {
    return describe_check(input_.instance, replay_) + describe_opinion();
  }
  [[nodiscard]] std::string more() const {
    const std::string clearance = describe_clearance(input_.instance, replay_);
    return (clearance.empty() ? "" : "           " + clearance + "\n") + describe_opinion();
  }
  [[nodiscard]] Json cost_json(Cost cost) const {
    return continuous::in_input_units(cost, input_.instance.resolution());
  }
  [[nodiscard]] Called called() const { return input::called(input_.names); }
  void add_measures(JsonLines& json) const {
    json.add("least_clearance", clearance_json(input_.instance, replay_));
    if (opinion_) json.add("second_opinion", opinion_json(input_.instance, *opinion_));
  }
  [[nodiscard]] Json violation_json(const continuous::Violation& violation) const {
    Json json;
    json["kind"] = to_string(violation.kind);
    json["agents"] = Json::array();
    if (violation.kind != continuous::Violation::Kind::path_count)
      json["agents"].push_back(violation.agent.index());
    if (violation.other) json["agents"].push_back(violation.other->index());
    json["time"] = continuous::in_input_units(violation.tick, input_.instance.resolution());
    json["tick"] = violation.tick.value();
    return json;
  }

 private:
  [[nodiscard]] std::string describe_opinion() const {
    return opinion_ ? cli::describe_opinion(input_.instance, *opinion_) : "";
  }

  const input::RoadmapInput& input_;
  const continuous::VerifyReport& replay_;
  const std::optional<continuous::SecondOpinion>& opinion_;
};

}  // namespace

ExitCode verify_roadmap(const CLI::App& app, const VerifyArguments& arguments) {
  std::string wrong = check_roadmap_options(arguments.roadmap, arguments.input, Need::plan);
  if (wrong.empty()) wrong = arguments.format.why_not_continuous("--plan-format");
  if (wrong.empty()) wrong = check_verify_outputs(arguments);
  if (!wrong.empty()) return usage_error(app, wrong);

  RoadmapPlan given(arguments.roadmap, arguments.input, arguments.plan,
                    arguments.format.continuous);
  const auto input = given.load();
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const auto file = given.read(*input);
  if (!file) {
    report_error(file.error());
    return ExitCode::bad_input;
  }
  if (!arguments.quiet) warn_of_durations(*input);
  const auto replay = verify(input->instance, file->plan);
  std::optional<continuous::SecondOpinion> opinion;
  if (arguments.check_with) opinion = ask_fcl(input->instance, file->plan);
  const ExitCode code =
      pronounce(arguments, RoadmapVerdict(*input, replay, opinion), *file, replay);
  const std::string contradiction = opinion ? find_contradiction(replay.valid(), *opinion) : "";
  if (contradiction.empty()) return code;
  report_error({ErrorCode::internal, "the two verifiers disagree: " + contradiction, {}});
  return ExitCode::internal;
}

}  // namespace quadrille::cli
