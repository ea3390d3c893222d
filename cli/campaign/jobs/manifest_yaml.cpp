// SPDX-License-Identifier: MIT
#include "campaign/jobs/manifest_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "quadrille/text/text_input.hpp"

namespace quadrille::cli::campaign {

using text::in_quotes;

void YamlAccess::refuse(long line, const std::string& message) const {
  throw Refused{{ErrorCode::syntax, message, {file_, line}}};
}

void YamlAccess::refuse(const YAML::Node& node, const std::string& message) const {
  refuse(line(node), message);
}

void YamlAccess::members(const YAML::Node& map, const std::string& what,
                         std::initializer_list<Member> known) const {
  if (!map.IsMap()) refuse(map, fmt::format("{} has to be a list of 'key: value'", what));
  std::set<std::string> seen;
  for (const auto& entry : map) {
    const std::string key = text(entry.first, "a key");
    const auto* found = std::find_if(known.begin(), known.end(),
                                     [&](const Member& member) { return member.key == key; });
    if (found == known.end()) {
      std::string names;
      for (const Member& member : known)
        names += (names.empty() ? "" : ", ") + std::string(member.key);
      refuse(entry.first,
             fmt::format("{} is no key of {}, which has {}", in_quotes(key), what, names));
    }
    if (!seen.insert(key).second)
      refuse(entry.first, fmt::format("the key {} is there twice", in_quotes(key)));
    found->read(entry.second);
  }
}

std::string YamlAccess::text(const YAML::Node& node, const std::string& what) const {
  if (!node.IsScalar() || node.Scalar().empty()) refuse(node, what + " has to be a text");
  return node.Scalar();
}

std::int64_t YamlAccess::natural(const YAML::Node& node, const std::string& what,
                                 std::int64_t least, std::int64_t most) const {
  const text::Natural number = text::parse_natural(node.IsScalar() ? node.Scalar() : "", most);
  if (number.fault != text::NumberFault::none || number.value < least)
    refuse(node, fmt::format("{} has to be a whole number from {} to {}", what, least, most));
  return number.value;
}

double YamlAccess::number(const YAML::Node& node, const std::string& what, double above) const {
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value) ||
      value <= above)
    refuse(node, fmt::format("{} has to be a number above {}", what, above));
  return value;
}

std::vector<std::string> YamlAccess::words(const YAML::Node& node, const std::string& what) const {
  std::vector<std::string> words;
  if (node.IsSequence()) {
    for (const YAML::Node& word : node) words.push_back(text(word, "each of " + what));
  } else if (node.IsScalar()) {
    std::istringstream in(node.Scalar());
    for (std::string word; in >> word;) words.push_back(word);
  } else if (!node.IsNull()) {
    refuse(node, what + " have to be a list of words");
  }
  return words;
}

}  // namespace quadrille::cli::campaign
