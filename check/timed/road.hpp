// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "read/json.hpp"

namespace quadrille_check {

/// Later than all that happens.
inline constexpr Int kNever = Int{1} << 61;

/// A place, or a difference of two.
using Point = std::array<Int, 3>;

/// A disc or sphere, or a convex polygon, which keeps its orientation.
struct Body {
  Int radius = 0;                                     // 0: a polygon
  std::shared_ptr<const std::vector<Point>> corners;  // of a polygon
};

/// A body that goes straight and at constant speed from one point to another, or stands.
struct Motion {
  Point from{}, to{};
  Int begin = 0, end = 0;
  Body body;
};

/// Bodies on a roadmap in continuous time, in whole ticks and length units. Times count
/// from the moment at which the instance begins.
struct Road {
  using Point = quadrille_check::Point;
  struct Edge {
    int from = 0, to = 0;
    std::uint64_t groups = ~std::uint64_t{0};
    std::optional<Int> duration = {}, most_speed = {};
  };
  struct Agent {
    int start = 0, goal = 0;
    Body body;
    Int speed = 1'000'000;  // millionths of a length unit per tick
    int group = 0;
    Int release = 0, deadline = kNever;
    bool leaves = false;     // at its goal, as soon as it comes there
    bool under_way = false;  // sets out at once
    std::size_t durations = 0;
  };
  std::vector<Point> points;
  std::vector<Edge> edges;
  std::vector<std::vector<int>> out, in;  // edges, by vertex
  std::vector<Agent> agents;
  std::vector<std::vector<Motion>> obstacles;  // where they go and stand, one after the other
  std::vector<std::vector<Int>> durations;     // by speed, by edge; 0: none

  [[nodiscard]] Int duration(int agent, int edge) const {
    return durations[agents[static_cast<std::size_t>(agent)].durations]
                    [static_cast<std::size_t>(edge)];
  }
  [[nodiscard]] bool may_use(int agent, int edge) const {
    const int group = agents[static_cast<std::size_t>(agent)].group;
    return (edges[static_cast<std::size_t>(edge)].groups >> group & 1) != 0 &&
           duration(agent, edge) > 0;
  }
};

/// Throws BadInput, also for what certificates know no rule for.
[[nodiscard]] Road read_road(const Json& root);

}  // namespace quadrille_check
