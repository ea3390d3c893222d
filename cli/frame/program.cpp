// SPDX-License-Identifier: MIT
#include "frame/program.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "frame/output.hpp"
#include "frame/signals.hpp"
#include "frame/subcommands.hpp"
#include "frame/suggestion.hpp"

namespace quadrille::cli {
namespace {

constexpr const char* kFooter =
    "Example:\n"
    "  quadrille solve --map empty-8-8.map --scen empty-8-8-random-1.scen --agents 10\n"
    "\n"
    "'quadrille COMMAND --help' describes a command and gives an example.\n"
    "\n";

constexpr const char* kVersion =
    "quadrille " QUADRILLE_VERSION
    " (MIT licence)\n"
    "with the SAT solver CaDiCaL " QUADRILLE_CADICAL_VERSION " (MIT licence)";

ExitCode print_stdout(const std::string& text) {
  Console console(false, false);
  console.print(text);
  if (console.failure() == 0) return ExitCode::success;
  report_write_failure("-", console.failure());
  return ExitCode::output;
}

ExitCode run(int argc, char** argv) {
  reserve_standard_streams();
  ignore_broken_pipes();
  CLI::App program("Quadrille: exact multi-agent path finding", "quadrille");
  program.set_version_flag("--version", kVersion);
  program.require_subcommand(1);
  program.footer(std::string(kFooter) + kExitCodesHelp);
  program.get_formatter()->column_width(28);
  const std::vector<Subcommand> subcommands = {
      add_solve(program),    add_explain(program),  add_verify(program), add_info(program),
      add_generate(program), add_convert(program),  add_view(program),   add_execute_check(program),
      add_simulate(program), add_dispatch(program), add_export(program), add_campaign(program)};
  const CLI::App* active = &program;
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return print_stdout(std::string(version.what()) + "\n");
  } catch (const CLI::Success&) {  // --help, at either level
    for (const Subcommand& subcommand : subcommands)
      if (subcommand.app->parsed()) active = subcommand.app;
    return print_stdout(active->help(active == &program ? "" : "quadrille"));
  } catch (const CLI::ParseError& error) {
    for (const Subcommand& subcommand : subcommands)
      if (subcommand.app->parsed()) active = subcommand.app;
    // An option that is not known explains best what is missing or too much.
    if (active->remaining_size() > 0)
      return usage_error(*active, describe_unexpected(*active, active->remaining().front()));
    return usage_error(*active, error.what());
  }
  for (const Subcommand& subcommand : subcommands) {
    if (!subcommand.app->parsed()) continue;
    if (const std::string wrong = check_standard_input(*subcommand.app); !wrong.empty())
      return usage_error(*subcommand.app, wrong);
    return subcommand.run();
  }
  return ExitCode::usage;
}

}  // namespace

int run_program(int argc, char** argv) {
  ExitCode code = ExitCode::internal;
  try {
    code = run(argc, argv);
  } catch (const std::bad_alloc&) {
    print_stderr("quadrille: error: the system has no more memory\n");
    code = ExitCode::memory;
  } catch (const std::exception& error) {
    report_error({ErrorCode::internal, error.what(), {}});
  }
  return static_cast<int>(code);
}

}  // namespace quadrille::cli
