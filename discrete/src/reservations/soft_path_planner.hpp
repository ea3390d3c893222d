// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/trace.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "reservations/soft_reservations.hpp"
#include "reservations/tie_breaker.hpp"

namespace quadrille::discrete {

/// Paths of single agents with as few meetings as possible: safe interval path planning with soft
/// obstacles (SIPPS; Li et al., "MAPF-LNS2: fast repairing for multi-agent path finding via large
/// neighbourhood search", AAAI 2022). A state is a vertex and a piece of time there in which nobody
/// comes or goes; it may have several labels, later ones with fewer meetings.
class SoftPathPlanner {
 public:
  struct Result {
    Path path;  ///< Trimmed.
    std::int64_t num_meetings = 0;
  };

  /// All outlive this object.
  SoftPathPlanner(const Instance& instance, const GoalDistances& distances, Random& random);

  /// A path of fewest meetings, now and after its end, with those reserved, and among these of
  /// least arrival; a random one among several. It has at most `most` meetings and arrives by
  /// `latest`. nullopt if there is none, if it would take more than `effort`, or if a limit was
  /// met. Requires that no path of the agent is reserved.
  std::optional<Result> find(AgentId agent, const SoftReservations& reservations, Timestep latest,
                             std::int64_t most, std::int64_t effort, LimitMonitor& limits);
  /// Labels expanded by all calls.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  using LabelIndex = std::uint32_t;
  static constexpr std::uint32_t kAtRest = UINT32_MAX;  // A piece: in the goal from now on.
  struct Label {
    VertexId vertex;
    std::uint32_t piece;
    Timestep time;  // Of the beginning of the stay in this piece.
    Timestep piece_end;
    std::uint32_t num_meetings;
    LabelIndex parent;
    LabelIndex next_here;  // Labels of the same vertex.
    bool is_outdated;      // Another one is not later and meets no more.
  };
  struct Head {
    std::uint32_t search = 0;
    LabelIndex first = kNoLabel;
  };
  /// Labels with the same number of meetings, by estimated arrival.
  struct Level {
    std::vector<std::vector<LabelIndex>> buckets;
    std::size_t at = 0, end = 0;  // The others are empty.
  };

  void begin(AgentId agent, const SoftReservations& reservations, Timestep latest,
             std::int64_t most);
  std::optional<LabelIndex> next();
  void expand(LabelIndex from);
  void wait(LabelIndex from);
  void reach(LabelIndex from, VertexId to);
  void rest(LabelIndex from);
  void add(const Label& label, Timestep distance);

  const Instance& instance_;
  const GoalDistances& distances_;
  TieBreaker ties_;
  std::int64_t effort_ = 0;

  // Of the current search.
  std::uint32_t search_ = 0;
  GoalDistances::Row row_;
  const Goals* goals_ = nullptr;
  const SoftReservations* reservations_ = nullptr;
  Timestep earliest_ = 0, latest_ = 0;  // No arrival before, none after.
  std::int64_t most_ = 0;
  IdVector<VertexId, Head> heads_;
  std::vector<Label> labels_;
  std::vector<Level> levels_;  // By number of meetings.
  std::size_t level_ = 0, num_levels_ = 0;
};

}  // namespace quadrille::discrete
