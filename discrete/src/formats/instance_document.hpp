// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/document.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// Sizes that a file only states, with nothing in it to show for them, end here: a few bytes of
/// text must not cost gigabytes.
inline constexpr std::int64_t kMaxDeclaredVertices = std::int64_t{1} << 23;

/// There are at most `most` vertices. Otherwise the checker has an error (out_of_range) at `node`.
bool has_most_vertices(Checker& checker, Document::Node node, std::int64_t count, std::size_t most);

/// `node` is a place of the graph: `[x, y]` of a passable cell, or a vertex number if the graph is
/// no grid. Otherwise the checker has an error with this code.
bool read_place(Checker& checker, const Document& document, const Graph& graph, Document::Node node,
                ErrorCode code, VertexId& vertex);

/// Why a cell is no vertex, such as "(3, 1) is blocked".
[[nodiscard]] std::string not_passable(const GridLayout& grid, std::int64_t x, std::int64_t y);

/// The vertex of a cell given by any numbers.
[[nodiscard]] std::optional<VertexId> find_vertex(const GridLayout& grid, std::int64_t x,
                                                  std::int64_t y);

/// One task, and where it stands in the document.
struct PlacedTask {
  Agent task;
  Document::Node start;
  Document::Node goal;  ///< Or all of them.
};

/// The timestep at which an instance or a plan begins.
bool read_now(Checker& checker, Document::Node node, Timestep& now);

/// The instance of these tasks. Errors (invalid_instance): two equal starts, or two equal goals of
/// agents that stay there and have no other one, at the later of the two places.
[[nodiscard]] Result<Instance> make_instance(Checker& checker, Graph graph,
                                             const std::vector<PlacedTask>& tasks, Timestep now = 0,
                                             Rules rules = {});

}  // namespace quadrille::discrete
