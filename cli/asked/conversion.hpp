// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"
#include "frame/output.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// What `convert` was asked on the command line, for either domain.
struct ConvertArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::string plan;  ///< Empty: the instance is converted.
  PlanFormats from, to;
  std::string output = "-";
};

/// Why the output may not be written; empty if it may.
[[nodiscard]] std::string check_convert_output(const ConvertArguments& arguments);

/// `load`: the input, `convert`: the text that becomes of it.
template <class Load, class Convert>
ExitCode convert_and_write(const std::string& file, const Load& load, const Convert& convert) {
  const auto output = OutputFile::probe(file);
  if (!output) {
    report_error(output.error());
    return ExitCode::output;
  }
  const auto input = load();
  if (!input) {
    report_error(input.error());
    return ExitCode::bad_input;
  }
  const auto text = convert(*input);
  if (!text) {
    report_error(text.error());
    return ExitCode::bad_input;
  }
  return write_or_report(*output, *text) ? ExitCode::success : ExitCode::output;
}

}  // namespace quadrille::cli
