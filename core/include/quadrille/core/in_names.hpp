// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What somebody calls agents and vertices, with quotes if there are to be any; nullopt: by their
/// numbers.
struct Called {
  std::function<std::optional<std::string>(std::size_t)> agent, vertex;
};

/// A message of the libraries, which know numbers only ("agents 0 and 3", "robot 2", "vertex 5"),
/// with names instead. Things that are told together have names only if all of them do.
[[nodiscard]] std::string in_names(std::string_view message, const Called& called);

}  // namespace quadrille

QUADRILLE_API_END
