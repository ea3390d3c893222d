// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/pose_grid.hpp"
#include "quadrille/continuous/pose_roadmap.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// Where robots that face this way do, in radians in (-pi, pi], from the axis of x towards that of
/// y. The rows of a grid go down, and so does y: south is pi / 2.
[[nodiscard]] double angle_of(continuous::Heading heading) noexcept;

/// Where robots face at each vertex, in radians in [-pi, pi], as angle_of.
using Yaws = IdVector<VertexId, double>;
[[nodiscard]] Yaws yaws_of(const continuous::PoseGrid& poses);
[[nodiscard]] Yaws yaws_of(const continuous::PoseRoadmap& poses);

/// In the instance's units and in radians; velocities are those of what comes next.
struct Sample {
  double time = 0, x = 0, y = 0, z = 0, vx = 0, vy = 0, vz = 0;
  double yaw = 0;  ///< In [-pi, pi], as angle_of.
  double turning = 0;
};

/// Where an agent is, and where it faces: along the move that it makes, or made last, and before
/// the first one along that. With `yaws` it faces as these say, and turns at constant speed from
/// one to the next by the shorter way, half a turn counter-clockwise. Polygons without shapes of
/// their own for that keep their orientation, and face along the axis of x.
class Sampler {
 public:
  /// `yaws`: of the vertices of robots that turn, or null. Keeps references to both.
  Sampler(const continuous::Instance& instance, const Yaws* yaws, double rate)
      : instance_(instance), yaws_(yaws), rate_(rate) {}

  /// `rate` times per unit of time, at both ends of each move and wait, and at the end of the path.
  [[nodiscard]] std::vector<Sample> samples(AgentId agent, const continuous::Path& path);

 private:
  /// A move or a wait: where it faces when that begins, and by how much it turns.
  struct Leg {
    VertexId from, to;
    continuous::Ticks begin, end;
    double yaw = 0, turn = 0;
  };
  [[nodiscard]] double units(continuous::Ticks ticks) const;
  /// At a vertex, standing still.
  [[nodiscard]] Sample at(VertexId vertex, continuous::Ticks time, double yaw) const;
  [[nodiscard]] Leg leg(const continuous::Stop& from, const continuous::Stop& to) const;
  [[nodiscard]] double first_yaw(const continuous::Path& path) const;
  /// From its beginning on, its end excluded.
  void add(const Leg& leg);

  const continuous::Instance& instance_;
  const Yaws* yaws_;
  double rate_;
  bool turns_ = true;      // Whether the agent does.
  double yaw_ = 0;         // Of the last leg.
  std::int64_t next_ = 0;  // Of the multiples of 1 / rate_.
  std::vector<Sample> samples_;
};

}  // namespace quadrille::exports

QUADRILLE_API_END
