// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/execution/precedences.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::execution {

/// Looks on while the clocks of a plan's agents run, and keeps how near they come to each other.
/// For reports: it computes in double, and where bodies overlap by less than 10^-10 of the largest
/// length involved they count as touching. Instance and plan must outlive it.
class ClearanceWatch {
 public:
  /// Requires a valid plan.
  ClearanceWatch(const continuous::Instance& instance, const continuous::Plan& plan);

  /// All clocks run evenly from `before` to `after`. O(agents^2).
  void add(std::span<const Ticks> before, std::span<const Ticks> after);

  /// The least free space between two bodies so far, in length units, negative if they overlapped;
  /// infinite for fewer than two agents.
  [[nodiscard]] double least() const noexcept { return least_; }
  /// The pairs of agents that have collided.
  [[nodiscard]] const std::set<std::pair<AgentId, AgentId>>& contacts() const noexcept {
    return contacts_;
  }

 private:
  struct Vector {
    double x = 0, y = 0, z = 0;
  };
  /// Where an agent is at some share of the period.
  struct Knot {
    double share = 0;
    Vector place;
    continuous::ShapeId shape = {};  ///< From then on.
  };
  void lay_out(AgentId agent, Ticks before, Ticks after);
  [[nodiscard]] Vector place(AgentId agent, double clock) const;
  /// Its shape after a tick, as long as its clock stands still there, or when it runs on.
  [[nodiscard]] continuous::ShapeId shape(AgentId agent, Ticks tick, bool stands_still) const;
  /// `offset`: of b from a.
  [[nodiscard]] static double gap(const geometry::Body& a, const geometry::Body& b,
                                  const Vector& offset);
  [[nodiscard]] double least_gap(const geometry::Body& a, const geometry::Body& b, double reach,
                                 const Vector& from, const Vector& to) const;
  void look_at(AgentId i, AgentId j);

  const continuous::Instance& instance_;
  const continuous::Plan& plan_;
  IdVector<AgentId, std::size_t> stops_;  // The last one reached.
  IdVector<AgentId, std::vector<Knot>> ways_;
  IdVector<AgentId, double>
      gone_;  // the share from which on it is nowhere, more than 1: it is there
  double least_ = std::numeric_limits<double>::infinity();
  double touch_ = 0;
  std::set<std::pair<AgentId, AgentId>> contacts_;
};

/// The same with timesteps: who is in one vertex with somebody else, or swaps places. The plan must
/// outlive it.
class ConflictWatch {
 public:
  /// `leaves`: who is nowhere after the step in which it arrives; empty: nobody.
  explicit ConflictWatch(const discrete::Plan& plan, IdVector<AgentId, bool> leaves = {})
      : plan_(plan), leaves_(std::move(leaves)) {}

  /// All agents go on from `before` to `after`, at most one timestep each, at the same time.
  /// O(agents * log).
  void add(std::span<const Ticks> before, std::span<const Ticks> after);

  [[nodiscard]] const std::set<std::pair<AgentId, AgentId>>& contacts() const noexcept {
    return contacts_;
  }

 private:
  const discrete::Plan& plan_;
  IdVector<AgentId, bool> leaves_;
  std::set<std::pair<AgentId, AgentId>> contacts_;
};

}  // namespace quadrille::execution

QUADRILLE_API_END
