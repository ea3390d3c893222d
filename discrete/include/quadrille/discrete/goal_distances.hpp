// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

class BreadthFirst;

/// What goals cost whoever ends there, besides the arrival: by vertex of the graph, >= 0. Those of
/// vertices that are nobody's goals do not matter.
using GoalPrices = IdVector<VertexId, Timestep>;

/// The number of moves from every vertex to every agent's goal, or to the nearest one of several,
/// whatever rules there are besides one-way edges.
/// Immutable, to be shared by all who search the same instance, from any thread.
///
/// A *plain* table takes 2 bytes per agent and vertex. Where it would be very large, or distances
/// do not fit, it is *packed* into somewhat more than half a byte: vertices are grouped around
/// centres that are at most 7 moves away; known are the distance of the centre, and of each vertex
/// the last four bits of its distance, which differs from that of the centre by at most 7.
/// That is not so where edges lead one way: of such graphs the table is *wide*, 4 bytes each.
class GoalDistances {
 public:
  /// A plain table that would take more bytes is packed. Measured: solving takes 4 % longer then on
  /// large maps, where plain tables are of 40 to 100 MiB.
  static constexpr std::size_t kMostPlain = std::size_t{256} << 20;

  /// One breadth-first search per agent: O(agents * (V + E)). Null when a limit was met.
  [[nodiscard]] static std::shared_ptr<const GoalDistances> make(
      const Instance& instance, LimitMonitor& limits, std::size_t most_plain = kMostPlain);

  /// Likewise with prices: the least sum of a distance and the price of the goal. Neighbours differ
  /// by one at most, as without. O(agents * (V + E + goals log goals)).
  [[nodiscard]] static std::shared_ptr<const GoalDistances> make(const Instance& instance,
                                                                 const GoalPrices& prices,
                                                                 LimitMonitor& limits);

  /// The distances to one agent's goals. Valid as long as the table.
  class Row {
   public:
    /// kUnreachable where there is no way.
    [[nodiscard]] Timestep operator[](VertexId vertex) const {
      if (plain_ == nullptr) return unpacked(vertex);
      return plain_[vertex.index()] == kNoWay ? kUnreachable : Timestep{plain_[vertex.index()]};
    }

   private:
    friend class GoalDistances;
    [[nodiscard]] Timestep unpacked(VertexId vertex) const {
      if (wide_ != nullptr) return wide_[vertex.index()];
      const Timestep centre = centres_[groups_[vertex.index()]];
      if (centre == kUnreachable) return kUnreachable;
      const int last_bits = bits_[vertex.index() / 2] >> (4 * (vertex.index() % 2));
      return centre + ((last_bits - centre + kRadius) & 15) - kRadius;
    }
    const std::uint16_t* plain_ = nullptr;  // Null: wide or packed.
    const Timestep* wide_ = nullptr;        // Null: packed.
    const std::uint8_t* bits_ = nullptr;    // Four of each vertex.
    const Timestep* centres_ = nullptr;     // Of each group.
    const std::uint32_t* groups_ = nullptr;
  };
  [[nodiscard]] Row row(AgentId agent) const {
    Row row;
    if (!plain_.empty()) {
      row.plain_ = plain_.data() + agent.index() * groups_.size();
      return row;
    }
    if (!wide_.empty()) {
      row.wide_ = wide_.data() + agent.index() * groups_.size();
      return row;
    }
    row.bits_ = bits_.data() + agent.index() * num_bytes();
    row.centres_ = centres_.data() + agent.index() * group_centre_.size();
    row.groups_ = groups_.data();
    return row;
  }

  /// Distances from another vertex of the graph, packed, in memory of its own. Valid as long as the
  /// table.
  class OwnRow {
   public:
    /// kUnreachable where there is no way.
    [[nodiscard]] Timestep operator[](VertexId vertex) const { return row_.unpacked(vertex); }

   private:
    friend class GoalDistances;
    std::vector<Timestep> wide_;
    std::vector<std::uint8_t> bits_;
    std::vector<Timestep> centres_;
    Row row_;  // Of the two.
  };
  [[nodiscard]] std::unique_ptr<const OwnRow> pack(
      const IdVector<VertexId, Timestep>& distances) const;

  /// kUnreachable where there is no way.
  [[nodiscard]] Timestep operator()(AgentId agent, VertexId vertex) const {
    return row(agent)[vertex];
  }

  /// What a goal costs besides: 0 in a table without prices.
  [[nodiscard]] Timestep price(VertexId goal) const { return prices_.empty() ? 0 : prices_[goal]; }

 private:
  friend class GoalDistancesInTheMaking;
  friend class ChangingGoalDistances;
  static constexpr std::uint16_t kNoWay = UINT16_MAX;
  static constexpr Timestep kRadius = 7;
  GoalDistances() = default;
  /// Makes room. False: a limit was met.
  [[nodiscard]] bool prepare(const Graph& graph, std::size_t num_agents, LimitMonitor& limits,
                             std::size_t most_plain);
  /// Fills in the distances of one agent. False: a limit was met.
  [[nodiscard]] bool fill(AgentId agent, const Goals& goals, BreadthFirst& search,
                          LimitMonitor& limits);
  /// `distances`: by vertex, and perhaps more.
  void keep(AgentId agent, const std::vector<Timestep>& distances);
  void group(const Graph& graph);
  [[nodiscard]] std::size_t num_bytes() const noexcept { return (groups_.size() + 1) / 2; }
  /// Packs the distances by vertex.
  void pack(const std::vector<Timestep>& distances, std::uint8_t* bits, Timestep* centres) const;

  bool is_wide_ = false;
  GoalPrices prices_;                        // Empty: none.
  std::vector<std::uint32_t> groups_;        // By vertex; without meaning in a wide table.
  std::vector<std::uint32_t> group_centre_;  // By group: a vertex.
  // By agent, then vertex or group.
  std::vector<std::uint16_t> plain_;  // Empty: wide or packed.
  std::vector<Timestep> wide_;        // Empty: plain or packed.
  std::vector<std::uint8_t> bits_;    // Four of each vertex.
  std::vector<Timestep> centres_;
};

/// A table that several threads make together. The same table, whoever does how much.
class GoalDistancesInTheMaking {
 public:
  /// `instance` outlives the object.
  explicit GoalDistancesInTheMaking(const Instance& instance) : instance_(instance) {}

  /// To be called by each of the threads, once. Helps until the table is there. Null when one of
  /// the caller's limits was met: what it has left is done by the others.
  [[nodiscard]] std::shared_ptr<const GoalDistances> join(LimitMonitor& limits);

 private:
  const Instance& instance_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<GoalDistances> table_;
  std::vector<AgentId> left_;  // that nobody is at
  std::size_t num_done_ = 0;   // agents
};

/// The table of agents whose goals change. One thread at a time.
class ChangingGoalDistances {
 public:
  /// To begin with all agents are everywhere at a goal. `graph` outlives the object.
  ChangingGoalDistances(const Graph& graph, std::size_t num_agents);
  ~ChangingGoalDistances();

  /// O(V + E).
  void set(AgentId agent, const Goals& goals);
  /// Wherever it is is a goal. O(V).
  void set_everywhere(AgentId agent);
  [[nodiscard]] const GoalDistances& table() const noexcept { return *table_; }

 private:
  std::unique_ptr<GoalDistances> table_;
  std::unique_ptr<BreadthFirst> search_;
  std::vector<Timestep> nothing_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
