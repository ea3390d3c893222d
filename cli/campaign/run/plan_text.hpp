// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::cli::campaign {

/// Plans on grids in few letters: u, d, l, r for a move up, down, left, right, where (0, 0) is the
/// upper left cell, and w for a wait, each after the number of times if that is more than one.
/// "4,0 3r2dw" begins at x = 4, y = 0.

/// The path of one agent in a result, a list of [x, y]; nullopt if it is no such list, or not one
/// of moves and waits.
[[nodiscard]] std::optional<std::string> encode_path(const nlohmann::ordered_json& path);
/// What encode_path made of a plan; nullopt if a cell is not one of the grid. Requires a grid.
[[nodiscard]] std::optional<discrete::Path> decode_path(const discrete::Graph& graph,
                                                        std::string_view text);

/// All agents; nullopt if a path cannot be encoded.
[[nodiscard]] std::optional<nlohmann::ordered_json> encode_plan(const nlohmann::ordered_json& plan);

}  // namespace quadrille::cli::campaign
