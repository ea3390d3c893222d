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

/// Reads an instance in the YAML of libMultiRobotPlanning: `map` with `dimensions` and `obstacles`,
/// or an undirected `roadmap`, and `agents` with `start` and `goal`, or `potentialGoals`, any one
/// of which is a goal. Anchors, aliases, unknown keys and tags other than `!!python/tuple` are
/// refused. Agents keep the order of the file; their names go to `names`, if that is given. Errors
/// as read_instance_json.
[[nodiscard]] Result<Instance> read_instance_yaml(std::istream& in, const std::string& file,
                                                  std::size_t most_vertices = SIZE_MAX,
                                                  text::Names* names = nullptr);
[[nodiscard]] Result<Instance> read_instance_yaml(const std::filesystem::path& path,
                                                  std::size_t most_vertices = SIZE_MAX);
/// Writes that YAML with agents named agent0, agent1, ... Errors: io; invalid_instance if the graph
/// is no grid, or if the instance begins later than at 0.
[[nodiscard]] std::optional<Error> write_instance_yaml(std::ostream& out, const std::string& file,
                                                       const Instance& instance,
                                                       const text::Names& names = {});

}  // namespace quadrille::discrete

QUADRILLE_API_END
