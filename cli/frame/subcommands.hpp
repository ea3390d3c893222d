// SPDX-License-Identifier: MIT
#pragma once

#include "frame/arguments.hpp"
#include "frame/option_parser.hpp"

namespace quadrille::cli {

[[nodiscard]] Subcommand add_solve(CLI::App& program);
[[nodiscard]] Subcommand add_explain(CLI::App& program);
[[nodiscard]] Subcommand add_verify(CLI::App& program);
[[nodiscard]] Subcommand add_info(CLI::App& program);
[[nodiscard]] Subcommand add_generate(CLI::App& program);
[[nodiscard]] Subcommand add_convert(CLI::App& program);
[[nodiscard]] Subcommand add_view(CLI::App& program);
[[nodiscard]] Subcommand add_campaign(CLI::App& program);
[[nodiscard]] Subcommand add_execute_check(CLI::App& program);
[[nodiscard]] Subcommand add_simulate(CLI::App& program);
[[nodiscard]] Subcommand add_dispatch(CLI::App& program);
[[nodiscard]] Subcommand add_export(CLI::App& program);

}  // namespace quadrille::cli
