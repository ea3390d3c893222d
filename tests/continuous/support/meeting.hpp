// SPDX-License-Identifier: MIT
//
// When bodies meet, for the oracle: one predicate over given moments, in exact arithmetic of its
// own. Everything else is found by trying moments.
#pragma once

#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"

namespace quadrille::continuous::test {

/// What a body does for a while, both ends included: a move, or a stay if the places are the same.
struct Element {
  Point from, to;
  Ticks begin = 0, end = 0;
};

/// Whether the bodies overlap at some moment that the elements share.
[[nodiscard]] bool meet(const Element& a, const Body& body_a, const Element& b, const Body& body_b);

/// Whole ticks from the first to the last.
struct Run {
  Ticks first = 0, last = 0;
};

/// By how much `b` can be put off if the moves are to meet; b may also begin earlier.
[[nodiscard]] std::optional<Run> meeting_starts(const Element& a, const Body& body_a,
                                                const Element& b, const Body& body_b);

/// Whether two bodies that are each somewhere on a way of their own can overlap: what they sweep
/// has interior points in common. Exact.
[[nodiscard]] bool sweeps_meet(const Element& a, const Body& body_a, const Element& b,
                               const Body& body_b);

/// What keeps a move clear of a stay: either of these.
struct Clearance {
  Ticks after_leaving = 0;   ///< It begins so long after the end of the stay, at least.
  Ticks before_arrival = 0;  ///< The stay begins so long after the begin of the move, at least.
};
/// Nothing if the move passes the place at a distance.
[[nodiscard]] std::optional<Clearance> clearance(const Element& move, const Body& mover,
                                                 Point place, const Body& resident);

/// Of bodies with shapes, which count during moves without the first and the last moment of these.
[[nodiscard]] std::optional<Run> without_ends(std::optional<Run> run, const Element& a,
                                              const Element& b);
[[nodiscard]] std::optional<Clearance> without_ends(std::optional<Clearance> clear,
                                                    const Element& move);

/// Whether the agent may use the edge.
[[nodiscard]] inline bool is_open(const Instance& instance, AgentId i, EdgeId e) {
  return instance.roadmap().edge(e).open_to.contains(instance.agent(i).group);
}

/// The answers for an instance, each computed when it is first asked for.
class Meetings {
 public:
  explicit Meetings(const Instance& instance);
  [[nodiscard]] const std::optional<Run>& moves(ClassId a, EdgeId e, ClassId b, EdgeId f);
  [[nodiscard]] const std::optional<Clearance>& stay(ClassId a, EdgeId e, ClassId b, VertexId v);

 private:
  template <class T>
  struct Known {
    bool is_known = false;
    std::optional<T> value;
  };
  [[nodiscard]] Element element(ClassId c, EdgeId e) const;
  /// One of the two.
  [[nodiscard]] bool have_shapes(ClassId a, ClassId b) const {
    return instance_.bodies(a).size() > 1 || instance_.bodies(b).size() > 1;
  }

  const Instance& instance_;
  std::vector<Known<Run>> moves_;
  std::vector<Known<Clearance>> stays_;
};

}  // namespace quadrille::continuous::test
