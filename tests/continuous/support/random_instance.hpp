// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// Draws for tests, the same on every platform.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : engine_(seed) {}
  /// Of [low, high].
  std::int64_t number(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  Length length(Length low, Length high) { return Length(number(low.value(), high.value())); }
  Ticks ticks(std::int64_t low, std::int64_t high) { return Ticks(number(low, high)); }
  bool chance(int percent) { return number(0, 99) < percent; }

 private:
  std::mt19937_64 engine_;
};

/// What random roadmaps look like. Lengths are small numbers of units, so that rounding, touching
/// and coincidences occur all the time.
struct RandomOptions {
  std::size_t num_vertices = 6;
  std::size_t num_agents = 3;
  Length size = 40;          ///< Coordinates are below.
  Length max_radius = 9;     ///< Drawn from 1 on; of polygons the largest coordinate.
  int edge_percent = 45;     ///< Of the pairs of vertices.
  int one_way_percent = 10;  ///< Of the edges.
  int polygon_percent = 20;  ///< Of the agents.
  bool equal_agents = false;
  /// Of the instances: places have heights and all bodies are spheres.
  int space_percent = 20;
  /// Of the instances: agents of three groups, and edges that are closed to some of these.
  int groups_percent = 20;
  /// Of the instances: some agents are released late.
  int release_percent = 15;
  /// Of the instances: some agents have deadlines.
  int deadline_percent = 15;
  /// Of the instances: some agents leave at their goals.
  int leaves_percent = 15;
  /// Of the instances: moving obstacles, one or two.
  int obstacles_percent = 15;
  /// Of the instances: some agents begin in the middle of a move.
  int under_way_percent = 0;
  /// Of the agents: they may end at any of two or three goals.
  int goal_sets_percent = 0;
  /// Of the instances in the plane: vertices and edges have shapes, and so have most agents.
  int shapes_percent = 15;
  /// Of the instances: edges with speed limits, and some that take one group another time.
  int paces_percent = 15;
  /// Of the instances: vertices where nobody may wait, among those where nobody begins or stays.
  int no_waiting_percent = 15;
};

/// The same for the same seed. Tries until the instance is valid.
[[nodiscard]] Instance random_instance(std::uint32_t seed, const RandomOptions& options);

/// Two agents on a roadmap of some size, few edges or many.
[[nodiscard]] Instance random_pair(std::uint32_t seed);

/// For messages of failing tests.
[[nodiscard]] std::string describe(const Instance& instance);

}  // namespace quadrille::continuous::test
