// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "paths/bans.hpp"
#include "paths/goal_distances.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::continuous {

/// Whose path is looked for.
struct PathTask {
  AgentId agent;
  const GoalDistances& distances;
  Detours& detours;
};

/// Safe-interval path planning (Phillips and Likhachev 2011, ICRA) with forbidden starts: cheapest
/// paths that obey a table of bans. Among all visits to a vertex within one safe stay only the
/// earliest matters, because an agent may wait until the stay ends. Where nobody may wait, all
/// ticks of arrival matter, as intervals that do not contain each other (soundness 11.26). A node
/// that is expanded takes
/// the moves whose detours its estimate allows, and waits for its turn with the next one (partial
/// expansion, Yoshizumi et al. 2000, AAAI): on roadmaps of high degree few are ever taken.
class PathFinder {
 public:
  /// Searches throw LimitReached when `limits` are met; null: there are none.
  explicit PathFinder(const Instance& instance, LimitMonitor* limits = nullptr)
      : instance_(instance), limits_(limits) {}

  /// Arrival of the cheapest path that arrives before `bound` and by the agent's deadline; nullopt
  /// if there is none. `path`, unless null, receives it.
  [[nodiscard]] std::optional<Ticks> find(const PathTask& task, BanTable& bans, Ticks bound,
                                          TimedPath* path);
  /// Whether there is such a path. The first one that is found will do, and what is nearest to the
  /// goal is looked at first: where there are some, takes a part of the time of `find`. Where there
  /// is none, a place may be looked at again each time that an earlier arrival turns up.
  [[nodiscard]] bool find_any(const PathTask& task, BanTable& bans, Ticks bound, TimedPath* path);

  [[nodiscard]] const Instance& instance() const noexcept { return instance_; }
  [[nodiscard]] std::int64_t num_runs() const noexcept { return num_runs_; }
  /// Of states, in all runs.
  [[nodiscard]] std::int64_t num_visits() const noexcept { return num_visits_; }
  /// Elementary steps, in all runs: visits, and edges looked at.
  [[nodiscard]] std::int64_t effort() const noexcept { return num_visits_ + num_edges_; }

 private:
  struct Node {
    VertexId vertex;
    std::uint32_t stay;  // which of the safe stays; kPasses: nobody may wait there
    Ticks arrive;
    Ticks leave_by;  // who passes arrives and leaves at any one tick from `arrive` to this one
    std::uint32_t parent;
    Move move;                       // that led here
    std::uint32_t num_expanded = 0;  // of the detours from here
  };
  static constexpr std::uint32_t kPasses = 0xffffffffu;
  /// From the first one to the last one.
  struct Arrivals {
    Ticks first, last;
    [[nodiscard]] bool contain(const Arrivals& other) const {
      return first <= other.first && other.last <= last;
    }
  };
  enum class Order { cheapest_first, nearest_first };
  struct Entry {
    Ticks key;  // the least goes first: by `order_` what the way costs at least, or its rest
    Ticks arrive;
    std::uint32_t node;
  };
  static bool is_later(const Entry& a, const Entry& b);

  std::optional<Ticks> search(Order order, const PathTask& task, BanTable& bans, Ticks bound,
                              TimedPath* path);
  void begin(Order order);
  /// Takes the moves with which the way is no longer than `estimate`.
  void expand(const PathTask& task, BanTable& bans, std::uint32_t node, Ticks estimate,
              Ticks bound);
  /// What `expand` does with a move to a vertex where nobody may wait.
  void pass(const PathTask& task, BanTable& bans, std::uint32_t node, EdgeId edge, Ticks bound);
  /// Whether other arrivals at the vertex are as good as all these. If not, they are kept.
  [[nodiscard]] bool is_known(VertexId v, const Arrivals& arrivals);
  [[nodiscard]] bool is_stale(const Node& node, BanTable& bans);
  void push(Ticks key, std::uint32_t node);
  void visit(const Node& node, Ticks rest);
  [[nodiscard]] std::size_t state(BanTable& bans, VertexId v, std::uint32_t stay);
  void trace(std::uint32_t node, TimedPath& path) const;

  const Instance& instance_;
  LimitMonitor* limits_;
  Order order_ = Order::cheapest_first;
  std::vector<Node> nodes_;
  std::vector<Entry> heap_;
  // States of vertices without bans come first, by vertex; others as they are met.
  std::vector<Ticks> best_;
  std::vector<std::uint32_t> stamp_;
  std::vector<std::size_t> first_state_;  // by place of the ban table
  std::vector<std::uint32_t> first_stamp_;
  std::size_t num_states_ = 0;
  std::vector<std::vector<Arrivals>> arrivals_;  // by vertex; of use where nobody may wait
  std::vector<std::size_t> passed_;              // the vertices that have any
  Ticks horizon_ = 0;                            // of the bans, likewise
  std::uint32_t run_ = 0;
  std::int64_t num_runs_ = 0, num_visits_ = 0, num_edges_ = 0;
};

}  // namespace quadrille::continuous
