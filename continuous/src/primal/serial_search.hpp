// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "primal/serial_moves.hpp"

namespace quadrille::continuous {

/// Looks for a serial plan among all arrangements of the agents: any roadmap, any bodies.
/// Best-first width search (Lipovetzky and Geffner, "Best-first width search: exploration and
/// exploitation in classical planning", AAAI 2017): what brings an agent, or two together, for the
/// first time somewhere while so many are not home goes first, then what is nearest to the goals.
/// Finds a plan if there is one, given effort and memory: the arrangements are exponentially many.
/// Deterministic.
class SerialSearch {
 public:
  enum class State {
    working,   ///< `advance` can go on.
    found,     ///< There is a plan.
    exhausted  ///< There is no serial plan, or the arrangements are too many.
  };

  /// `bodies` outlives it. Requires that all agents are apart.
  explicit SerialSearch(StandingBodies& bodies);

  /// Goes on for about so much effort. Throws LimitReached.
  State advance(std::int64_t effort);
  /// Requires State::found.
  [[nodiscard]] std::vector<SerialMove> moves() const;
  /// Elementary steps so far, some 10 ns each.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  using Node = std::uint32_t;
  struct Entry {
    std::uint32_t novelty;  // 0: of one agent, 1: of two, 2: none
    std::uint32_t distance;
    Node node;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };
  struct Step {
    Node parent = 0;
    SerialMove move;
  };
  /// Where the agents are: their vertices, or num_vertices for who is gone.
  [[nodiscard]] std::uint32_t* places_of(Node node) { return &places_[node * num_agents_]; }

  void find_distances();
  void add(Node parent, const SerialMove& move);
  void load(Node node);
  void expand(Node node);
  [[nodiscard]] std::uint32_t novelty_of(const std::uint32_t* places, std::size_t moved,
                                         std::size_t num_away);
  [[nodiscard]] bool is_new(Node node, std::uint64_t hash);
  void grow_table();

  StandingBodies& bodies_;
  const Instance& instance_;
  LimitMonitor& limits_;
  const std::size_t num_agents_, num_places_;
  Standing standing_;
  std::vector<std::vector<std::uint32_t>> distances_;  // by agent, by vertex: moves to its goal
  std::vector<std::uint32_t> places_;                  // by node and agent
  std::vector<Step> steps_;                            // by node
  std::vector<std::uint64_t> hashes_;                  // by node
  std::vector<Node> table_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  bool has_pairs_ = false;
  std::vector<bool> seen_, seen_pairs_;  // by number of agents away, then what is where
  State state_ = State::working;
  Node goal_ = 0;
  std::int64_t effort_ = 0;
};

}  // namespace quadrille::continuous
