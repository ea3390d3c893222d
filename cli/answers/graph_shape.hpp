// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace quadrille::cli {

/// What `info` says of a graph, of either domain.
struct GraphShape {
  std::vector<std::size_t> components;         ///< Their sizes, in any order.
  std::map<std::size_t, std::size_t> degrees;  ///< How many vertices have each degree.
};

/// The lines "components", with the largest ones, and "degrees".
[[nodiscard]] std::string describe_shape(GraphShape shape);

}  // namespace quadrille::cli
