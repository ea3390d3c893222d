// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "quadrille/core/in_names.hpp"
#include "quadrille/text/names.hpp"
#include "quadrille/text/text_input.hpp"

namespace quadrille::input {

/// For messages. The names have to outlive it.
[[nodiscard]] inline Called called(const text::Names& names) {
  return {[&names](std::size_t i) -> std::optional<std::string> {
            const std::string* const name = names.agent(i);
            return name != nullptr ? std::optional(text::in_quotes(*name)) : std::nullopt;
          },
          [&names](std::size_t v) -> std::optional<std::string> {
            if (v >= names.vertices.size()) return std::nullopt;
            const std::string& name = names.vertices[v];  // JSON
            if (!name.starts_with('"')) return name;
            return text::in_quotes(std::string_view(name).substr(1, name.size() - 2));
          }};
}

}  // namespace quadrille::input
