// SPDX-License-Identifier: MIT
#include "quadrille/text/names.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "quadrille/text/text_input.hpp"

namespace quadrille::text {
namespace {

using Node = Document::Node;

bool is_utf8(std::string_view text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

/// A string, a whole number, or a list of such, as JSON.
bool read_value(Checker& check, const Document& document, Node node, std::string& text) {
  switch (document.kind(node)) {
    case Document::Kind::string:
      text += quoted_json(document.text(node));
      return true;
    case Document::Kind::integer:
      text += std::to_string(document.integer(node));
      return true;
    case Document::Kind::array: {
      const char* separator = "[";
      if (document.first(node) == document.next(node)) text += separator;
      for (Node n = document.first(node); n < document.next(node); n = document.next(n)) {
        text += separator;
        separator = ", ";
        if (!read_value(check, document, n, text)) return false;
      }
      text += "]";
      return true;
    }
    default:
      return check.fail(node, "a vertex is called by a text, a whole number or a list of these");
  }
}

}  // namespace

std::string quoted_json(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      quoted += "\\u00";
      quoted += kDigits[code >> 4U];
      quoted += kDigits[code & 15U];
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

bool read_name(Checker& check, const Document& document, Node node,
               std::optional<std::string>& name) {
  if (document.kind(node) == Document::Kind::integer) {  // YAML without quotes
    name = std::to_string(document.integer(node));
    return true;
  }
  if (document.kind(node) != Document::Kind::string) return check.fail(node, "expected a name");
  name = document.text(node);
  return is_utf8(*name) || check.fail(node, "the name is not UTF-8");
}

bool read_names(Checker& check, const Document& document, Node list,
                std::vector<std::optional<std::string>>& names) {
  if (!check.array(list, "names")) return false;
  for (Node n = document.first(list); n < document.next(list); n = document.next(n)) {
    names.emplace_back();
    if (document.kind(n) == Document::Kind::null) continue;
    if (!read_name(check, document, n, names.back())) return false;
  }
  return true;
}

bool read_vertex_names(Checker& check, const Document& document, Node list, std::size_t most,
                       std::vector<std::string>& names) {
  if (!check.array(list, "names")) return false;
  std::set<std::string> known;
  for (Node n = document.first(list); n < document.next(list); n = document.next(n)) {
    if (names.size() == most)
      return check.fail(n, ErrorCode::invalid_instance,
                        "there are only " + std::to_string(most) + " vertices");
    if (!read_value(check, document, n, names.emplace_back())) return false;
    if (!known.insert(names.back()).second)
      return check.fail(n, ErrorCode::invalid_instance, "another vertex has this name");
  }
  return true;
}

bool are_distinct(Checker& check, const std::vector<std::optional<std::string>>& agents,
                  const std::vector<Node>& places) {
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const std::string name = agents[i].value_or(std::to_string(i));
    const auto [other, is_new] = known.emplace(name, i);
    if (!is_new)
      return check.fail(places[i], ErrorCode::invalid_instance,
                        "agents " + std::to_string(other->second) + " and " + std::to_string(i) +
                            " are both called " + in_quotes(name));
  }
  return true;
}

}  // namespace quadrille::text
