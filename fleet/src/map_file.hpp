// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/fleet/roadmap.hpp"

namespace quadrille::fleet {

/// For a reader, at the builder's resolution. Errors: out_of_range for a speed that is not
/// supported.
[[nodiscard]] Result<continuous::MapFileOptions> map_file_options(const RoadmapBuilder& roads,
                                                                  MetresPerSecond speed);

/// Adds the roadmap of a file that was read with these options. `names`: by vertex, empty for none.
/// The new vertices, in the order of the file.
[[nodiscard]] std::vector<VertexId> add_roadmap(RoadmapBuilder& roads,
                                                const continuous::Roadmap& graph,
                                                const std::vector<std::string>& names);

}  // namespace quadrille::fleet
