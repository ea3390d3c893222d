// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "quadrille/fleet/fleet.hpp"

namespace quadrille::fleet::test {

using namespace quadrille::units;

/// A straight road of vertices "a", "b", ..., a metre from each to the next.
[[nodiscard]] Roadmap line(std::size_t num_vertices, Resolution resolution = {});

/// Some robots, discs and rectangles of several speeds, on a random roadmap of a few metres whose
/// vertices are joined to near ones. Starts and goals may overlap. The same seed, the same fleet.
[[nodiscard]] Fleet random_fleet(std::uint32_t seed, std::size_t num_robots);

}  // namespace quadrille::fleet::test
