// SPDX-License-Identifier: MIT
#include "quadrille/core/in_names.hpp"

#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

namespace quadrille {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// A number from the text on; moves past it.
std::optional<std::size_t> take_number(std::string_view& text) {
  constexpr std::size_t kMostDigits = 9;
  std::size_t length = 0, number = 0;
  while (length < text.size() && is_digit(text[length])) {
    number = 10 * number + static_cast<std::size_t>(text[length] - '0');
    if (++length > kMostDigits) return std::nullopt;
  }
  // "0.5" and "3rd" are none.
  const bool goes_on = length < text.size() && is_part_of_word(text[length]);
  const bool is_decimal =
      length + 1 < text.size() && text[length] == '.' && is_digit(text[length + 1]);
  if (length == 0 || goes_on || is_decimal) return std::nullopt;
  text.remove_prefix(length);
  return number;
}

/// "0, 1 and 2" in names; moves past it. Nullopt if that is no such list, or one has no name.
std::optional<std::string> take_list(
    std::string_view& text, const std::function<std::optional<std::string>(std::size_t)>& called) {
  std::string names;
  std::string_view rest = text;
  for (;;) {
    const auto number = take_number(rest);
    const auto name = number ? called(*number) : std::nullopt;
    if (!name) return std::nullopt;
    names += *name;
    text = rest;
    std::string_view separator;
    for (const std::string_view known : {std::string_view(" and "), std::string_view(", ")})
      if (rest.starts_with(known)) separator = known;
    if (separator.empty() || rest.size() == separator.size() || !is_digit(rest[separator.size()]))
      return names;
    names += separator;
    rest.remove_prefix(separator.size());
  }
}

}  // namespace

std::string in_names(std::string_view message, const Called& called) {
  const std::array<std::pair<std::string_view, const decltype(called.agent)*>, 5> words = {
      {{"agents ", &called.agent},
       {"agent ", &called.agent},
       {"robot ", &called.agent},
       {"vertices ", &called.vertex},
       {"vertex ", &called.vertex}}};
  std::string text;
  while (!message.empty()) {
    bool is_replaced = false;
    if (text.empty() || !is_part_of_word(text.back()))
      for (const auto& [word, name_of] : words) {
        if (!message.starts_with(word)) continue;
        std::string_view rest = message.substr(word.size());
        const auto names = take_list(rest, *name_of);
        if (!names) continue;
        text += *names;
        message = rest;
        is_replaced = true;
        break;
      }
    if (is_replaced) continue;
    text += message.front();
    message.remove_prefix(1);
  }
  return text;
}

}  // namespace quadrille
