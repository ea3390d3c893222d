// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "exit_codes.hpp"

namespace quadrille::cli {

/// One subcommand: its options, already added to the program, and what it does once they are read.
struct Subcommand {
  CLI::App* app;
  std::function<ExitCode()> run;
};

/// Adds an option that takes a whole number in [least, most], written in decimal digits and nothing
/// else.
CLI::Option* add_integer(CLI::App& app, const std::string& name,
                         std::optional<std::int64_t>& number, std::int64_t least,
                         std::int64_t most, const std::string& help);

/// Adds an option that takes a finite number of seconds >= 0.
CLI::Option* add_seconds(CLI::App& app, const std::string& name, std::optional<double>& number,
                         const std::string& help);

/// Adds an option that takes a file name, which may not be empty.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& file,
                      const std::string& help);

/// Says on stderr what is wrong with the command line.
ExitCode usage_error(const CLI::App& app, const std::string& message);

}  // namespace quadrille::cli
