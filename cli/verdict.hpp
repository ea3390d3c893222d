// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <string>

#include "exit_codes.hpp"
#include "input.hpp"
#include "outcome_check.hpp"
#include "output.hpp"
#include "report.hpp"
#include "roadmap/roadmap_input.hpp"

namespace quadrille::cli {

/// What `verify` was asked on the command line, for either domain.
struct VerifyArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::string plan;
  PlanFormats format;
  bool quiet = false;
};

/// Prints the verdict on a plan: `good` if it has no fault, else its faults and `more`. `input`:
/// the first lines of the human output.
template <class PlanFile, class VerifyReport>
ExitCode pronounce(bool quiet, const std::string& input, const PlanFile& file,
                   const VerifyReport& replay, const std::string& good, const std::string& more) {
  const std::string wrong =
      replay.valid() ? find_false_statements(file.stated, replay.sum_of_costs, replay.makespan)
                     : "";
  const bool valid = replay.valid() && wrong.empty();
  Console console(quiet, false);
  console.print(input);
  if (valid)
    console.print(good);
  else if (replay.valid())
    console.print("invalid    the plan breaks no rule, but its file states what is wrong\n" +
                  wrong);
  else
    console.print(fmt::format("invalid    {} violation{}\n", replay.violations.size(),
                              replay.violations.size() == 1 ? "" : "s") +
                  more + describe_violations(replay));
  if (console.failure() != 0) {
    report_write_failure("-", console.failure());
    return ExitCode::output;
  }
  return valid ? ExitCode::success : ExitCode::violations;
}

}  // namespace quadrille::cli
