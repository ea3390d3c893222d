// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "read/basics.hpp"

namespace quadrille_check {

/// As much of JSON as instances need: objects, lists, texts and natural numbers. All functions
/// throw BadInput when the value is of another kind.
struct Json {
  char kind = '0';                 // { [ " or 0
  std::vector<std::string> names;  // of the members of an object
  std::vector<Json> members;
  std::string content;
  Int value = 0;

  [[nodiscard]] const Json* find(const std::string& key) const;  ///< Null: there is none.
  [[nodiscard]] const Json& at(const std::string& key) const;
  /// An object has no keys but these.
  void only(const std::set<std::string>& keys) const;
  [[nodiscard]] std::vector<const Json*> list() const;
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] Int number(Int least, Int most) const;
};

[[nodiscard]] Json parse_json(const std::string& text);

}  // namespace quadrille_check
