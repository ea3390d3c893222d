// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"

namespace quadrille::continuous {

/// A stretch of a way along which somebody goes straight, or stands (from == to, or `stands`).
struct Piece {
  Ticks begin, end;
  Point from, to;
  VertexId start, goal;   ///< Of an obstacle: none.
  Ticks behind = 0;       ///< Ticks of the way from `from` to `to` that are over at `begin`,
  Ticks whole = 0;        ///< of so many; 0: end - begin.
  bool stands = false;    ///< On that way.
  bool is_first = false;  ///< A stay at the start of the path, or the move from there.

  /// Of the whole way so many ticks lie behind at a tick, of so many.
  [[nodiscard]] Ticks done(Ticks tick) const { return stands ? behind : behind + (tick - begin); }
  [[nodiscard]] Ticks all() const { return whole > 0 ? whole : end - begin; }
};

/// "stands at vertex 3", "moves from vertex 3 to vertex 4"
[[nodiscard]] std::string describe(const Piece& piece);

/// The way of an agent or a moving obstacle as pieces without gaps, one after the other. The last
/// one ends at a given time, which is after every arrival, or with the way if who goes it leaves.
class Trip {
 public:
  /// The path is sound. All must outlive this.
  Trip(const Roadmap& roadmap, const Path& path, bool leaves, Ticks horizon)
      : roadmap_(&roadmap), path_(&path), leaves_(leaves), horizon_(horizon) {}
  Trip(const MovingObstacle& obstacle, Ticks horizon)
      : obstacle_(&obstacle), leaves_(obstacle.leaves), horizon_(horizon) {}

  [[nodiscard]] std::optional<Piece> next();

 private:
  [[nodiscard]] std::optional<Piece> next_piece();
  struct At {
    Ticks arrive, depart;
    Point place;
    VertexId vertex;
    const LanePlace* on_lane = nullptr;
  };
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] At at(std::size_t k) const;

  const Roadmap* roadmap_ = nullptr;
  const Path* path_ = nullptr;
  const MovingObstacle* obstacle_ = nullptr;
  bool leaves_;
  Ticks horizon_;
  std::size_t stop_ = 0;
  bool has_stood_ = false;  // at `stop_`
};

}  // namespace quadrille::continuous
