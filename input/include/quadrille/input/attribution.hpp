// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/text/document.hpp"

namespace quadrille::input {

/// How a domain reads a vertex. Returns whether all is well; the checker has the error.
using ReadVertex = std::function<bool(text::Checker&, text::Document::Node, VertexId&)>;

/// What a JSON result says of its lower bound under the key "attribution" (docs/formats.md);
/// nullopt if it says nothing, and of other plan files. `text`: of a file that has been read as a
/// plan of `num_agents` agents. Errors, with the line: a wrong form, other agents than these,
/// raises that do not sum up to what the lower bound is above the free bound. What is claimed is
/// not looked into.
[[nodiscard]] Result<std::optional<Attribution>> read_attribution(const std::string& text,
                                                                  const std::string& file,
                                                                  std::size_t num_agents,
                                                                  const ReadVertex& read_vertex);

}  // namespace quadrille::input
