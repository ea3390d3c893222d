// SPDX-License-Identifier: MIT
#include "answers/graph_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadrille::cli {

std::string describe_shape(GraphShape shape) {
  constexpr std::size_t kShown = 8;
  std::vector<std::size_t>& sizes = shape.components;
  std::sort(sizes.rbegin(), sizes.rend());
  std::string text = fmt::format("components {}", sizes.size());
  for (std::size_t i = 0; i < std::min(kShown, sizes.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? ", of " : ", ", sizes[i]);
  if (sizes.size() > kShown) text += ", ...";
  text += sizes.empty() ? "\n" : " vertices\n";
  text += "degrees    ";
  const char* separator = "";
  for (const auto& [degree, vertices] : shape.degrees) {
    text += fmt::format("{}{}: {}", separator, degree, vertices);
    separator = ", ";
  }
  return text + "\n";
}

}  // namespace quadrille::cli
