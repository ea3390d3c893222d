// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "read/basics.hpp"

namespace quadrille_check {

/// As much of JSON as instances need: objects, lists, texts, numbers, true and false. All functions
/// throw BadInput when the value is of another kind.
struct Json {
  char kind = '0';                 // { [ " 0 t or f
  std::vector<std::string> names;  // of the members of an object
  std::vector<Json> members;
  std::string content;
  std::optional<Int> value;  // of a natural number that is small
  double real = 0;           // of any number

  [[nodiscard]] const Json* find(const std::string& key) const;  ///< Null: there is none.
  [[nodiscard]] const Json& at(const std::string& key) const;
  /// An object has no keys but these.
  void only(const std::set<std::string>& keys) const;
  [[nodiscard]] std::vector<const Json*> list() const;
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] bool is_true() const;
  [[nodiscard]] Int number(Int least, Int most) const;
  [[nodiscard]] double any_number() const;
};

[[nodiscard]] Json parse_json(const std::string& text);
/// Throws BadInput with the name of the file.
[[nodiscard]] Json read_json_file(const std::string& file);

}  // namespace quadrille_check
