// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <system_error>

namespace quadrille::cli {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& text,
                         const std::string& wanted) {
  throw CLI::ValidationError(name, fmt::format("'{}' is not {}", text, wanted));
}

/// The whole text as a number; nullopt if it is anything else.
template <class Number>
std::optional<Number> parse_whole(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

}  // namespace

CLI::Option* add_integer(CLI::App& app, const std::string& name,
                         std::optional<std::int64_t>& number, std::int64_t least,
                         std::int64_t most, const std::string& help) {
  const auto read = [&number, name, least, most](const std::string& text) {
    const auto parsed = parse_whole<std::int64_t>(text);
    if (!parsed || *parsed < least || *parsed > most)
      refuse(name, text, fmt::format("a whole number from {} to {}", least, most));
    number = *parsed;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("N");
}

CLI::Option* add_seconds(CLI::App& app, const std::string& name, std::optional<double>& number,
                         const std::string& help) {
  const auto read = [&number, name](const std::string& text) {
    const auto parsed = parse_whole<double>(text);
    // from_chars knows "inf" and "nan", and -0 is not less than 0.
    if (!parsed || !std::isfinite(*parsed) || std::signbit(*parsed))
      refuse(name, text, "a number of seconds, 0 or more");
    number = *parsed;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("SECONDS");
}

CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& file,
                      const std::string& help) {
  const auto read = [&file, name](const std::string& text) {
    if (text.empty()) refuse(name, text, "a file name");
    file = text;
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("FILE");
}

ExitCode usage_error(const CLI::App& app, const std::string& message) {
  const std::string parent = app.get_parent() == nullptr ? "" : app.get_parent()->get_name() + " ";
  fmt::print(stderr, "quadrille: {}\nSee '{}{} --help'.\n", message, parent, app.get_name());
  return ExitCode::usage;
}

}  // namespace quadrille::cli
