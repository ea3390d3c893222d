// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/text/names.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// The value of `version` in instance files.
inline constexpr int kInstanceJsonVersion = 1;

/// Reads an instance in this project's JSON (docs/formats.md): a roadmap and its agents in one
/// file, in the file's own units of length and time, which `resolution` turns into whole length
/// units and ticks. Unknown and repeated keys, missing keys and wrong types are refused. Errors:
/// io, syntax, out_of_range, invalid_instance; with file, line and, once the syntax is right, the
/// JSON path of the value, such as `/agents/3/start`.
[[nodiscard]] Result<Instance> read_instance_json(std::istream& in, const std::string& file,
                                                  text::Names* names = nullptr);
[[nodiscard]] Result<Instance> read_instance_json(const std::filesystem::path& path);
/// Whether this is the text of such a file rather than of an instance on a graph or a grid: JSON
/// with the key `roadmap`. What else may be wrong with it is for the reader to say.
[[nodiscard]] bool is_roadmap_json(const std::string& text);

/// Reading it back gives an equal instance. Errors: io when the stream fails.
[[nodiscard]] std::optional<Error> write_instance_json(std::ostream& out, const std::string& file,
                                                       const Instance& instance,
                                                       const text::Names& names = {});

}  // namespace quadrille::continuous

QUADRILLE_API_END
