// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "answers/delivery.hpp"
#include "answers/outcome_check.hpp"
#include "answers/report.hpp"
#include "frame/arguments.hpp"
#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"
#include "quadrille/core/in_names.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// What `verify` was asked on the command line, for either domain.
struct VerifyArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::string plan;
  std::string json;  ///< Output file; empty without, "-" for standard output.
  PlanFormats format;
  std::optional<SecondVerifier> check_with;
  bool quiet = false;
};

/// What is wrong with the options about outputs; empty if nothing is.
[[nodiscard]] std::string check_verify_outputs(const VerifyArguments& arguments);

/// Prints the verdict on a plan, and writes it to `--json`: documented in docs/cli.md. `Domain`
/// supplies what differs:
///
///     describe_input()            the first lines of the human output
///     good()                      what is said of a plan without faults
///     more()                      what is said besides the violations of one that has some
///     violation_json(violation)   "kind", agents, place, time
///     cost_json(cost)             a cost as users see it
///     add_measures(json)          further keys of the JSON
///     called()                    what agents and vertices are called in messages
template <class Domain, class PlanFile, class VerifyReport>
ExitCode pronounce(const VerifyArguments& arguments, const Domain& domain, const PlanFile& file,
                   const VerifyReport& replay) {
  const std::vector<std::string> wrong =
      replay.valid() ? find_false_statements(file.stated, replay.sum_of_costs, replay.makespan)
                     : std::vector<std::string>();
  const bool valid = replay.valid() && wrong.empty();
  Delivery delivery(arguments.quiet, "", arguments.json);
  if (!delivery.probe()) return ExitCode::output;
  if (delivery.has_json_file()) {
    JsonLines json("verdict");
    json.add("valid", valid);
    json.add("sum_of_costs", replay.valid() ? domain.cost_json(replay.sum_of_costs) : Json());
    json.add("makespan", replay.valid() ? domain.cost_json(replay.makespan) : Json());
    domain.add_measures(json);
    json.add("false_statements", wrong);
    json.add_list("violations", replay.violations, [&](const auto& violation) {
      Json item = domain.violation_json(violation);
      item["message"] = in_names(violation.message, domain.called());
      return item;
    });
    delivery.write_json(json.finish());
  }
  std::string verdict = domain.good();
  if (!replay.valid()) {
    verdict = fmt::format("invalid    {} violation{}\n", replay.violations.size(),
                          replay.violations.size() == 1 ? "" : "s") +
              domain.more() + in_names(describe_violations(replay), domain.called());
  } else if (!wrong.empty()) {
    verdict = "invalid    the plan breaks no rule, but its file states what is wrong\n";
    for (const std::string& statement : wrong) verdict += statement + "\n";
  }
  delivery.print_summary(domain.describe_input() + verdict, "");
  return delivery.finish(valid ? ExitCode::success : ExitCode::violations);
}

}  // namespace quadrille::cli
