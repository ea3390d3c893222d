// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "frame/exit_codes.hpp"
#include "frame/option_parser.hpp"

namespace quadrille::cli {

/// One subcommand: its options, already added to the program, and what it does once they are read.
struct Subcommand {
  CLI::App* app;
  std::function<ExitCode()> run;
};

/// Throws the usage error "'text' is not <wanted>" for the option.
[[noreturn]] void refuse_value(const std::string& name, const std::string& text,
                               const std::string& wanted);

/// Adds an option that takes a whole number in [least, most], written in decimal digits and nothing
/// else.
CLI::Option* add_integer(CLI::App& app, const std::string& name,
                         std::optional<std::int64_t>& number, std::int64_t least, std::int64_t most,
                         const std::string& help);

/// Adds an option that takes a finite number of seconds >= 0.
CLI::Option* add_seconds(CLI::App& app, const std::string& name, std::optional<double>& number,
                         const std::string& help);
/// A number of at least 0.
CLI::Option* add_per_cents(CLI::App& app, const std::string& name, std::optional<double>& number,
                           const std::string& help);
/// A cost in the units of the input, 0 or more.
CLI::Option* add_cost(CLI::App& app, const std::string& name, std::optional<double>& number,
                      const std::string& help);
/// Adds an option that takes a number in [0, 1].
CLI::Option* add_share(CLI::App& app, const std::string& name, std::optional<double>& number,
                       const std::string& help);

/// Adds an option that takes a finite number > 0.
CLI::Option* add_positive(CLI::App& app, const std::string& name, std::optional<double>& number,
                          const std::string& help);

/// Adds an option that takes a file name, which may not be empty.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& file,
                      const std::string& help);

/// The same for a file that is read: "-" is standard input, in `file` as input::kStandardInput.
CLI::Option* add_input_file(CLI::App& app, const std::string& name, std::string& file,
                            const std::string& help);
/// What is wrong if several options of the command line name standard input; empty if none is.
[[nodiscard]] std::string check_standard_input(const CLI::App& app);

/// Adds an option that takes one of some words, which `read` understands or refuses.
CLI::Option* add_word(CLI::App& app, const std::string& name,
                      const std::function<void(const std::string&)>& read, const std::string& help);

/// Adds an option that takes one of `names`, as `choose` understands them.
template <class Choice>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Choice& choice,
                        const std::string& names, std::optional<Choice> (*choose)(std::string_view),
                        const std::string& help) {
  const auto read = [&choice, name, names, choose](const std::string& text) {
    const auto chosen = choose(text);
    if (!chosen) refuse_value(name, text, names);
    choice = *chosen;
  };
  return add_word(app, name, read, help);
}

/// Who checks plans besides `verify`.
enum class SecondVerifier { fcl };
/// Adds --check-with.
CLI::Option* add_check_with(CLI::App& app, std::optional<SecondVerifier>& verifier);

/// Says on stderr what is wrong with the command line.
ExitCode usage_error(const CLI::App& app, const std::string& message);

}  // namespace quadrille::cli
