// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/text/document.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// Looks into objects that have more keys than those that are read. Returns, like Checker, whether
/// all is well.
class OpenObjects {
 public:
  using Node = Document::Node;

  OpenObjects(const Document& document, Checker& check) : document_(document), check_(check) {}

  /// Goes through keys and values until `visit(key, value)` says that something is wrong.
  template <class Visit>
  bool each_member(Node object, std::string_view what, const Visit& visit) {
    if (document_.kind(object) != Document::Kind::object)
      return check_.fail(object, "expected " + std::string(what));
    for (Node key = document_.first(object); key < document_.next(object);) {
      const Node value = document_.next(key);
      if (!visit(key, value)) return false;
      key = document_.next(value);
    }
    return true;
  }

  struct Wanted {
    std::string_view name;
    std::optional<Node>* value;
    bool required = true;
  };
  /// Finds keys, each at most once. `other(key)` hears of those that are not wanted.
  template <class Other>
  bool find_all(Node object, std::string_view what, std::initializer_list<Wanted> wanted,
                const Other& other) {
    const bool is_fine = each_member(object, what, [&](Node key, Node value) {
      for (const Wanted& one : wanted) {
        if (one.name != document_.text(key)) continue;
        if (*one.value) return check_.fail(key, "the key is there twice");
        *one.value = value;
        return true;
      }
      other(key);
      return true;
    });
    if (!is_fine) return false;
    for (const Wanted& one : wanted)
      if (one.required && !*one.value)
        return check_.fail(object, std::string(what) + " has the key '" + std::string(one.name) +
                                       "', which is missing here");
    return true;
  }
  bool find_all(Node object, std::string_view what, std::initializer_list<Wanted> wanted) {
    return find_all(object, what, wanted, [](Node) {});
  }

  /// The elements of a list, likewise.
  template <class Visit>
  bool each_element(Node list, std::string_view what, const Visit& visit) {
    if (!check_.array(list, what)) return false;
    for (Node n = document_.first(list); n < document_.next(list); n = document_.next(n))
      if (!visit(n)) return false;
    return true;
  }

 private:
  const Document& document_;
  Checker& check_;
};

}  // namespace quadrille::text

QUADRILLE_API_END
