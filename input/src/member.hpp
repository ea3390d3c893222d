// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "quadrille/text/document.hpp"

namespace quadrille::input {

/// The value of a key of the document, which is an object.
[[nodiscard]] inline std::optional<text::Document::Node> member(const text::Document& document,
                                                                std::string_view name) {
  using Node = text::Document::Node;
  Node key = document.first(text::Document::kRoot);
  while (key < document.next(text::Document::kRoot)) {
    const Node value = document.next(key);
    if (document.text(key) == name) return value;
    key = document.next(value);
  }
  return std::nullopt;
}

}  // namespace quadrille::input
