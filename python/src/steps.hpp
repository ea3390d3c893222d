// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "quadrille/discrete/graph.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solving.hpp"

namespace quadrille::python {

/// The vertex of a place: its number, or the cell (x, y) on a grid. `name` is for messages.
VertexId vertex_of(const discrete::Graph& graph, const std::int64_t* place,
                   const std::string& name);
/// And back: as many numbers as name a place.
std::size_t place_size(const discrete::Graph& graph);
void write_place(const discrete::Graph& graph, VertexId v, std::int32_t* place);

/// Takes what the arguments say of a search on a grid or a graph.
discrete::SolveOptions options_of(Arguments& arguments, const std::atomic<bool>& interrupt);

}  // namespace quadrille::python
