// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::continuous::test {

/// The moves of one agent, whenever they begin.
struct Route {
  std::vector<EdgeId> edges;
  Ticks duration = 0;  ///< Of the moves, without waits.
};

/// Who is in whose way, computed when first asked for.
class Meetings {
 public:
  explicit Meetings(const Instance& instance) : instance_(instance) {}
  [[nodiscard]] const Instance& instance() const { return instance_; }
  const std::optional<geometry::OffsetInterval>& offsets(ClassId a, EdgeId e, ClassId b, EdgeId f);
  const std::optional<geometry::ContactWindow>& window(ClassId a, EdgeId e, ClassId b, VertexId v);

 private:
  using Key = std::array<std::size_t, 4>;
  [[nodiscard]] geometry::BodyPair pair(ClassId a, ClassId b) const;

  const Instance& instance_;
  std::map<Key, std::optional<geometry::OffsetInterval>> offsets_;
  std::map<Key, std::optional<geometry::ContactWindow>> windows_;
};

/// time[to] >= time[from] + gap. Variable 0 is tick 0, the others are starts of moves.
struct Constraint {
  std::size_t from, to;
  Ticks gap;
};

/// The orders in which some agents can make given moves. For each order, the earliest times are the
/// longest paths of a system of difference constraints.
class RouteOrders {
 public:
  static constexpr Cost kNoLimit = std::numeric_limits<Cost>::max();
  /// Takes times and cost; returns the cost that what comes next has to be below.
  using Visit = std::function<Cost(const std::vector<Ticks>& times, Cost cost)>;

  RouteOrders(Meetings& meetings, Objective objective)
      : meetings_(meetings), objective_(objective) {}
  /// The agent is in the way of those that were added before.
  void add(AgentId agent, const Route& route);
  void visit(Cost limit, const Visit& visit);
  /// Least cost if it is below `limit`.
  [[nodiscard]] std::optional<Cost> least(Cost limit);
  /// Paths in the order in which agents were added.
  [[nodiscard]] Plan plan(const std::vector<Ticks>& times) const;

 private:
  struct Traveller {
    AgentId agent;
    const Route* route;
    std::size_t first;  // the variable of its first move
  };
  /// One of two constraints has to hold; the second one may be impossible.
  struct Choice {
    Constraint first;
    std::optional<Constraint> second;
  };

  [[nodiscard]] ClassId class_of(const Traveller& t) const;
  [[nodiscard]] Ticks duration(const Traveller& t, std::size_t move) const;
  void add_moves(const Traveller& i, const Traveller& j);
  void add_stays(const Traveller& i, const Traveller& j);
  bool tighten(std::vector<Ticks>& times) const;
  void branch(std::vector<Ticks> times, const Visit& visit);
  [[nodiscard]] Cost cost_of(const std::vector<Ticks>& times) const;

  Meetings& meetings_;
  const Objective objective_;
  std::size_t size_ = 1;
  std::vector<Traveller> travellers_;
  std::vector<Constraint> constraints_;
  std::vector<Choice> choices_;
  Cost limit_ = kNoLimit;
};

}  // namespace quadrille::continuous::test
