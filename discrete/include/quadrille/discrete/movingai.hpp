// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/text/text_input.hpp"

// MovingAI `.map` and `.scen` files; docs/formats-of-others.md has examples. For all readers
// and writers:
//   - `file` only names the stream in messages; streams need not be seekable (pipes work).
//   - Reader errors carry file and line: io (cannot open or read; a directory), syntax (the format
//   is
//     not followed; a NUL byte), out_of_range (larger than the limits below), invalid_instance.
//   - LF and CR LF line ends are both accepted. Nothing is repaired, nothing is printed.
//   - Writers return io when the stream fails, which includes a failing flush at the end.

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// Larger maps are refused before anything of their size is allocated.
inline constexpr std::int64_t kMaxMapCells = std::int64_t{1} << 26;
/// Larger files, of any format, are refused.
inline constexpr std::size_t kMaxFileBytes = text::kMaxFileBytes;

/// Which letters of a map agents may stand on. Without options `.` and `G` are passable and `@`,
/// `O` and `T` are blocked; every other letter is refused until one of these lists names it. The
/// lists also overrule the defaults. A letter in both lists is an error (out_of_range) of read_map.
struct MapOptions {
  std::string passable;  ///< For instance "S" or "SW".
  std::string blocked;
};

/// How often a letter other than `.`, `@` and `T` occurred, and how it was read: worth a line to
/// the user, since programs differ in their treatment.
struct LetterCount {
  char letter = 0;
  bool passable = false;
  std::int64_t cells = 0;
  friend bool operator==(const LetterCount&, const LetterCount&) = default;
};

/// A grid with passable and blocked cells.
struct GridMap {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<bool> passable;              ///< width * height entries, row by row.
  std::vector<LetterCount> other_letters;  ///< By letter; empty for generated maps.

  [[nodiscard]] bool is_passable(Cell cell) const {  ///< Requires a cell of the map.
    return passable[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(cell.x)];
  }
  [[nodiscard]] std::int64_t num_passable() const;
  /// The 4-connected graph of the passable cells. O(cells).
  [[nodiscard]] Graph graph() const { return Graph::grid(width, height, passable); }
  friend bool operator==(const GridMap&, const GridMap&) = default;
};

/// Reads a `.map` file. The header is `type octile`, `height H`, `width W`, `map`; in published
/// files the first line may be missing, width may come before height, and blanks may end a line.
/// Exactly H rows of exactly W letters follow, and then nothing but empty lines. H and W are
/// positive.
[[nodiscard]] Result<GridMap> read_map(std::istream& in, const std::string& file,
                                       const MapOptions& options = {});
[[nodiscard]] Result<GridMap> read_map(const std::filesystem::path& path,
                                       const MapOptions& options = {});
/// Writes `.` for passable and `@` for blocked cells.
[[nodiscard]] std::optional<Error> write_map(std::ostream& out, const std::string& file,
                                             const GridMap& map);

/// One row of a scenario: one possible agent.
struct ScenarioRow {
  std::int64_t bucket = 0;
  std::string map;  ///< Name of the map; informative only.
  std::int32_t width = 0;
  std::int32_t height = 0;
  Cell start;
  Cell goal;
  double optimal = 0;  ///< Length of a shortest octile path without cutting corners; informative.
  long line = 0;       ///< In the file it was read from; 0 for generated rows.
};

/// The rows of a `.scen` file.
struct Scenario {
  std::string file;  ///< For messages; empty for generated scenarios.
  std::vector<ScenarioRow> rows;
};

/// Reads a `.scen` file: `version 1` or `version 1.0`, then rows of nine fields separated by blanks
/// or tabs. The form of every row is checked; see make_instance for the rest.
[[nodiscard]] Result<Scenario> read_scenario(std::istream& in, const std::string& file);
[[nodiscard]] Result<Scenario> read_scenario(const std::filesystem::path& path);
/// A remark, for the user, on the first row whose width and height are not those of the map; empty
/// if there is none.
[[nodiscard]] std::string note_on_sizes(const Scenario& scenario, std::int32_t width,
                                        std::int32_t height);
/// Writes `version 1` and one row per agent, separated by tabs, `optimal` with eight digits.
/// Requires that map names are neither empty nor contain white space.
[[nodiscard]] std::optional<Error> write_scenario(std::ostream& out, const std::string& file,
                                                  const Scenario& scenario);

/// The instance of the first `num_agents` rows; 0 is allowed. Requires a grid graph. Errors
/// (invalid_instance), with the file and line of the row: fewer rows than agents; a cell of any row
/// that is outside of the grid; among the first `num_agents` rows a cell that is blocked, or two
/// equal starts or goals (the message names both lines). Width and height of the rows are not
/// compared with the grid's, as published files have wrong ones: see note_on_sizes.
[[nodiscard]] Result<Instance> make_instance(std::shared_ptr<const Graph> graph,
                                             const Scenario& scenario, std::size_t num_agents);

}  // namespace quadrille::discrete

QUADRILLE_API_END
