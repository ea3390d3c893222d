// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// What random roadmaps look like. Lengths are small numbers of units, so that rounding, touching
/// and coincidences occur all the time.
struct RandomOptions {
  std::size_t num_vertices = 6;
  std::size_t num_agents = 3;
  Length size = 40;          ///< Coordinates are below.
  Length max_radius = 9;     ///< Drawn from 1 on.
  int edge_percent = 45;     ///< Of the pairs of vertices.
  int one_way_percent = 10;  ///< Of the edges.
  bool equal_agents = false;
};

/// The same for the same seed. Tries until the instance is valid.
[[nodiscard]] Instance random_instance(std::uint32_t seed, const RandomOptions& options);

/// For messages of failing tests.
[[nodiscard]] std::string describe(const Instance& instance);

}  // namespace quadrille::continuous::test
