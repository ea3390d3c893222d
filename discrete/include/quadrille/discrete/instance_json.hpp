// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/text/names.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The value of `version` in instance files.
inline constexpr int kInstanceJsonVersion = 1;

/// Reads an instance in this project's JSON, on a graph or on a grid (docs/formats.md). Unknown and
/// repeated keys, missing keys and wrong types are refused. Errors: io, syntax, out_of_range (sizes
/// above kMaxMapCells or kMaxFileBytes) and invalid_instance; with file, line and, once the syntax
/// is right, the JSON path of the value, such as `/agents/3/start`. More than `most_vertices`
/// vertices are refused (out_of_range) before a graph is made of them; `solve` takes kMaxVertices.
[[nodiscard]] Result<Instance> read_instance_json(std::istream& in, const std::string& file,
                                                  std::size_t most_vertices = SIZE_MAX,
                                                  text::Names* names = nullptr);
[[nodiscard]] Result<Instance> read_instance_json(const std::filesystem::path& path,
                                                  std::size_t most_vertices = SIZE_MAX);
/// Writes the grid form for grids, the graph form otherwise. Reading it back gives an equal
/// instance.
[[nodiscard]] std::optional<Error> write_instance_json(std::ostream& out, const std::string& file,
                                                       const Instance& instance,
                                                       const text::Names& names = {});

}  // namespace quadrille::discrete

QUADRILLE_API_END
