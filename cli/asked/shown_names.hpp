// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/text/names.hpp"

namespace quadrille::cli {

/// Of the agents, for pages: of those without a name an empty text.
[[nodiscard]] inline std::vector<std::string> shown_names(const text::Names& names) {
  std::vector<std::string> shown;
  for (const auto& name : names.agents) shown.push_back(name.value_or(""));
  return shown;
}

}  // namespace quadrille::cli
