// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "frame/exit_codes.hpp"
#include "frame/input_options.hpp"
#include "frame/output.hpp"
#include "frame/picture_arguments.hpp"
#include "quadrille/input/roadmap.hpp"

namespace quadrille::cli {

/// What `view` was asked on the command line, for either domain.
struct ViewArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::string plan;
  PlanFormats format;
  std::string output;  ///< Of the page; empty: standard output, unless there is a picture.
  PictureArguments picture;
};

/// What is wrong with the options about outputs, in either domain; empty if nothing is.
[[nodiscard]] std::string check_view_outputs(const ViewArguments& arguments);

/// `load`: the input, `read`: the plan file for it, `page` and `draw`: the page and the picture of
/// both.
template <class Load, class Read, class Page, class Draw>
ExitCode view_and_write(const ViewArguments& arguments, const Load& load, const Read& read,
                        const Page& page, const Draw& draw) {
  const bool only_picture = arguments.output.empty() && !arguments.picture.file.empty();
  Result<OutputFile> outputs[] = {
      OutputFile::probe(arguments.output.empty() ? "-" : arguments.output),
      OutputFile::probe(arguments.picture.file.empty() ? "-" : arguments.picture.file)};
  for (const auto& output : outputs)
    if (!output) {
      report_error(output.error());
      return ExitCode::output;
    }
  const auto refuse = [](const Error& error) {
    report_error(error);
    return ExitCode::bad_input;
  };
  const auto input = load();
  if (!input) return refuse(input.error());
  if (auto error = check_picture_agents(arguments.picture, input->instance.num_agents()))
    return refuse(*error);
  const auto file = read(*input);
  if (!file) return refuse(file.error());
  if (!only_picture && !write_or_report(*outputs[0], page(*input, file->plan)))
    return ExitCode::output;
  if (arguments.picture.file.empty()) return ExitCode::success;
  const Result<std::string> picture = draw(*input, file->plan);
  if (!picture) return refuse(picture.error());
  return write_or_report(*outputs[1], *picture) ? ExitCode::success : ExitCode::output;
}

}  // namespace quadrille::cli
