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
/// earliest matters, because an agent may wait until the stay ends. A node that is expanded takes
/// the moves whose detours its estimate allows, and waits for its turn with the next one (partial
/// expansion, Yoshizumi et al. 2000, AAAI): on roadmaps of high degree few are ever taken.
class PathFinder {
 public:
  /// Searches throw LimitReached when `limits` are met; null: there are none.
  explicit PathFinder(const Instance& instance, LimitMonitor* limits = nullptr)
      : instance_(instance), limits_(limits) {}

  /// Arrival of the cheapest path that arrives before `bound` and by the agent's deadline; nullopt
  /// if there is none. `path`, unless null, receives it. `relevant`, unless null, is marked by
  /// slot: no path arrives before `bound` even if only the marked slots are switched on. Without
  /// result only.
  [[nodiscard]] std::optional<Ticks> find(const PathTask& task, BanTable& bans, Ticks bound,
                                          TimedPath* path, std::vector<char>* relevant = nullptr);

  [[nodiscard]] std::int64_t num_runs() const noexcept { return num_runs_; }
  /// Of states, in all runs.
  [[nodiscard]] std::int64_t num_visits() const noexcept { return num_visits_; }
  /// Elementary steps, in all runs: visits, and edges looked at.
  [[nodiscard]] std::int64_t effort() const noexcept { return num_visits_ + num_edges_; }

 private:
  struct Node {
    VertexId vertex;
    std::uint32_t stay;  // which of the safe stays
    Ticks arrive;
    Ticks leave_by;
    std::uint32_t parent;
    Move move;                       // that led here
    std::uint32_t num_expanded = 0;  // of the detours from here
  };
  struct Entry {
    Ticks estimate, arrive;
    std::uint32_t node;
  };
  static bool is_later(const Entry& a, const Entry& b);

  static void blame_start(BanTable& bans, std::uint32_t place, Ticks release,
                          std::vector<char>& relevant);
  void begin(const PathTask& task);
  /// Takes the moves with which the way is no longer than `estimate`.
  void expand(const PathTask& task, BanTable& bans, std::uint32_t node, Ticks estimate,
              Ticks bound);
  void push(Ticks estimate, std::uint32_t node);
  void visit(const Node& node, Ticks estimate);
  [[nodiscard]] std::size_t state(BanTable& bans, VertexId v, std::uint32_t stay);
  void mark(const PathTask& task, BanTable& bans, const Node& node, Ticks bound,
            std::vector<char>& relevant) const;
  void trace(std::uint32_t node, TimedPath& path) const;

  const Instance& instance_;
  LimitMonitor* limits_;
  std::vector<Node> nodes_;
  std::vector<Entry> heap_;
  // States of vertices without bans come first, by vertex; others as they are met.
  std::vector<Ticks> best_;
  std::vector<std::uint32_t> stamp_;
  std::vector<std::size_t> first_state_;  // by place of the ban table
  std::vector<std::uint32_t> first_stamp_;
  std::size_t num_states_ = 0;
  std::uint32_t run_ = 0;
  std::int64_t num_runs_ = 0, num_visits_ = 0, num_edges_ = 0;
};

}  // namespace quadrille::continuous
