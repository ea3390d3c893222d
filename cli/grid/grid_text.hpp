// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "grid/grid_text.hpp"
#include "quadrille/input/grid.hpp"

namespace quadrille::cli {

/// "8 x 8 grid, 64 vertices, 112 edges"
[[nodiscard]] std::string describe_graph(const discrete::Graph& graph);
/// One line per unusual letter.
[[nodiscard]] std::string describe_letters(const std::vector<discrete::LetterCount>& letters);
/// The lines "map" and "agents" of the human output, and one line per unusual letter.
[[nodiscard]] std::string describe_input(const input::GridInput& input);

}  // namespace quadrille::cli
