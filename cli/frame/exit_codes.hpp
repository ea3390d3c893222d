// SPDX-License-Identifier: MIT
#pragma once

namespace quadrille::cli {

/// What the program tells the shell. Documented in docs/cli.md, `--help` and the man page.
enum class ExitCode : int {
  success = 0,  ///< Solved to optimality; a valid plan; what was asked is done.
  /// `verify`: the plan breaks a rule; `execute-check`, `export`: a cycle; `campaign`:
  /// contradictions, or every job failed.
  violations = 1,
  feasible = 10,    ///< A plan that is not proved optimal.
  infeasible = 20,  ///< Proved: no plan exists.
  unknown = 30,     ///< A limit or a signal ended the search before it found a plan.
  usage = 64,       ///< The command line is wrong.
  bad_input = 65,   ///< A file cannot be read, or what it says is wrong.
  internal = 70,    ///< A check of the program's own work failed.
  memory = 71,      ///< The system has no more memory, other than within a search.
  output = 74,      ///< An output cannot be written.
};

/// The table above as text.
inline constexpr const char* kExitCodesHelp =
    "Exit codes:\n"
    "   0  solved to optimality; for other commands: done, or the plan is valid\n"
    "   1  verify: the plan breaks a rule; execute-check, export: moves in a cycle;\n"
    "      campaign: answers contradict each other, or every job failed\n"
    "  10  a plan, but not proved optimal\n"
    "  20  proved infeasible: no plan exists\n"
    "  30  unknown: a limit or a signal ended the search before it found a plan\n"
    "  64  wrong command line\n"
    "  65  bad input: a file that cannot be read, or that is wrong\n"
    "  70  a check of the program's own work failed\n"
    "  71  the system has no more memory, other than within a search\n"
    "  74  an output cannot be written\n";

}  // namespace quadrille::cli
