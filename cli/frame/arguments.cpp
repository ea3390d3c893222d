// SPDX-License-Identifier: MIT
#include "frame/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "frame/output.hpp"
#include "quadrille/input/source.hpp"

namespace quadrille::cli {
namespace {

/// Tells the options for files that are read from those for outputs.
constexpr const char* kInputType = "INPUT";

/// The whole text as a number; nullopt if it is anything else.
template <class Number>
std::optional<Number> parse_whole(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& number,
                        double most, const std::string& wanted, const std::string& help) {
  const auto read = [&number, name, most, wanted](const std::string& text) {
    const auto parsed = parse_whole<double>(text);
    // from_chars knows "inf" and "nan", and -0 is not less than 0.
    if (!parsed || !std::isfinite(*parsed) || std::signbit(*parsed) || *parsed > most)
      refuse_value(name, text, wanted);
    number = *parsed;
  };
  return app.add_option_function<std::string>(name, read, help);
}

}  // namespace

void refuse_value(const std::string& name, const std::string& text, const std::string& wanted) {
  throw CLI::ValidationError(name, fmt::format("'{}' is not {}", text, wanted));
}

CLI::Option* add_integer(CLI::App& app, const std::string& name,
                         std::optional<std::int64_t>& number, std::int64_t least, std::int64_t most,
                         const std::string& help) {
  const auto read = [&number, name, least, most](const std::string& text) {
    const auto parsed = parse_whole<std::int64_t>(text);
    if (!parsed || *parsed < least || *parsed > most)
      refuse_value(name, text, fmt::format("a whole number from {} to {}", least, most));
    number = *parsed;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("N");
}

CLI::Option* add_seconds(CLI::App& app, const std::string& name, std::optional<double>& number,
                         const std::string& help) {
  constexpr double kMost = std::numeric_limits<double>::max();
  return add_number(app, name, number, kMost, "a number of seconds, 0 or more", help)
      ->type_name("SECONDS");
}

CLI::Option* add_per_cents(CLI::App& app, const std::string& name, std::optional<double>& number,
                           const std::string& help) {
  constexpr double kMost = std::numeric_limits<double>::max();
  return add_number(app, name, number, kMost, "a number of per cent, 0 or more", help)
      ->type_name("PER CENT");
}

CLI::Option* add_cost(CLI::App& app, const std::string& name, std::optional<double>& number,
                      const std::string& help) {
  constexpr double kMost = std::numeric_limits<double>::max();
  return add_number(app, name, number, kMost, "a cost, 0 or more", help)->type_name("COST");
}

CLI::Option* add_share(CLI::App& app, const std::string& name, std::optional<double>& number,
                       const std::string& help) {
  return add_number(app, name, number, 1, "a number from 0 to 1", help)->type_name("SHARE");
}

CLI::Option* add_positive(CLI::App& app, const std::string& name, std::optional<double>& number,
                          const std::string& help) {
  const auto read = [&number, name](const std::string& text) {
    const auto parsed = parse_whole<double>(text);
    if (!parsed || !std::isfinite(*parsed) || *parsed <= 0)
      refuse_value(name, text, "a positive number");
    number = *parsed;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("X");
}

CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& file,
                      const std::string& help) {
  const auto read = [&file, name](const std::string& text) {
    if (text.empty()) refuse_value(name, text, "a file name");
    file = text;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("FILE");
}

CLI::Option* add_input_file(CLI::App& app, const std::string& name, std::string& file,
                            const std::string& help) {
  const auto read = [&file, name](const std::string& text) {
    if (text.empty()) refuse_value(name, text, "a file name");
    file = text == "-" ? input::kStandardInput : text;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name(kInputType);
}

std::string check_standard_input(const CLI::App& app) {
  const CLI::Option* first = nullptr;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_type_name() != kInputType || option->results() != CLI::results_t{"-"}) continue;
    if (first != nullptr)
      return fmt::format("{} and {} both name standard input", first->get_name(),
                         option->get_name());
    first = option;
  }
  return "";
}

CLI::Option* add_word(CLI::App& app, const std::string& name,
                      const std::function<void(const std::string&)>& read,
                      const std::string& help) {
  return app.add_option_function<std::string>(name, read, help)->type_name("NAME");
}

CLI::Option* add_check_with(CLI::App& app, std::optional<SecondVerifier>& verifier) {
  return add_choice<std::optional<SecondVerifier>>(
      app, "--check-with", verifier, "fcl",
      [](std::string_view text) -> std::optional<std::optional<SecondVerifier>> {
        if (text != "fcl") return std::nullopt;
        return SecondVerifier::fcl;
      },
      "Roadmaps: ask another verifier, too: fcl, with a tolerance. Exit code 70 if it\n"
      "contradicts the first one");
}

ExitCode usage_error(const CLI::App& app, const std::string& message) {
  const std::string parent = app.get_parent() == nullptr ? "" : app.get_parent()->get_name() + " ";
  print_stderr(fmt::format("quadrille: {}\nSee '{}{} --help'.\n", message, parent, app.get_name()));
  return ExitCode::usage;
}

}  // namespace quadrille::cli
