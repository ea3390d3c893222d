// SPDX-License-Identifier: MIT
#include "frame/suggestion.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

namespace quadrille::cli {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
    return table[i * width + j];
  };
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      at(i, j) = std::min(
          {at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(a.size(), b.size());
}

std::string closest(std::string_view written, const std::vector<std::string>& words) {
  std::size_t least = written.size() / 3 + 1;
  std::string found;
  for (const std::string& word : words) {
    const std::size_t distance = edit_distance(written, word);
    if (distance >= least) continue;
    least = distance;
    found = word;
  }
  return found;
}

std::string describe_unexpected(const CLI::App& app, const std::string& written) {
  const std::string name = written.substr(0, written.find('='));
  const bool is_option = name.starts_with('-');
  std::vector<std::string> words;
  if (is_option) {
    for (const CLI::Option* option : app.get_options())
      for (const std::string& word : option->get_lnames()) words.push_back("--" + word);
  } else {
    for (const CLI::App* command : app.get_subcommands(nullptr))
      words.push_back(command->get_name());
  }
  const std::string meant = closest(name, words);
  const std::string hint = meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
  if (is_option) return fmt::format("there is no option '{}'{}", name, hint);
  if (!words.empty()) return fmt::format("'{}' is no command{}", name, hint);
  return fmt::format("'{}' was not expected", written);
}

}  // namespace quadrille::cli
