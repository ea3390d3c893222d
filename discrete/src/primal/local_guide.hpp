// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pibt/guidance.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "reservations/tie_breaker.hpp"

namespace quadrille::discrete {

/// A short path for each agent from where it is now, such that they meet in few places: whoever
/// moves all agents by a timestep along them looks ahead as far as they go. A path may meet others,
/// at a price, so that there always is one. To be made anew at each timestep; paths that were
/// followed are what the others look at until it is their turn.
///
/// Local guidance: Arita and Okumura, "Local guidance for configuration-based multi-agent
/// pathfinding", arXiv 2510.19072, 2025.
class LocalGuide final : public Guidance {
 public:
  /// Timesteps of a path.
  static constexpr std::uint32_t kWindow = 10;
  /// Timesteps that an agent would rather take longer than meet others at one.
  static constexpr std::uint32_t kPenalty = 2;

  /// What it takes.
  [[nodiscard]] static std::size_t num_bytes(const Instance& instance);

  /// All outlive this object. Requires an agent.
  LocalGuide(const Instance& instance, const GoalDistances& distances, Random& random);

  /// Makes a path for each agent of the order, one after the other. Each is as cheap as can be with
  /// regard to all others as they are then: it costs its timesteps, the way that is left at its
  /// end, and kPenalty for each timestep at which it meets others. Requires goals that can be
  /// reached from the configuration.
  void renew(std::span<const VertexId> configuration, std::span<const AgentId> order);
  /// Where the agent's path leads first; nullopt if it does not begin at the vertex.
  [[nodiscard]] std::optional<VertexId> next(AgentId agent, VertexId from) const override;
  /// The path of an agent, kWindow + 1 vertices. Requires that it was renewed.
  [[nodiscard]] std::span<const VertexId> path(AgentId agent) const {
    return std::span(paths_).subspan(agent.index() * kSize, kSize);
  }
  /// Labels expanded by all calls.
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  static constexpr std::size_t kSize = kWindow + 1;  // Vertices of a path.
  /// A path that costs more than to stay and meet others all the time is not looked at.
  static constexpr std::size_t kMostExtra = (1 + kPenalty) * kWindow;
  static constexpr std::size_t kNumBuckets = (kMostExtra + 1) * (2 * kWindow + 1);
  using LabelIndex = std::uint32_t;
  using Count = std::uint16_t;

  struct Label {
    VertexId vertex;
    std::uint32_t time;       // Since now.
    std::uint32_t penalties;  // In all.
    LabelIndex parent;
    LabelIndex next_in_bucket;
  };

  [[nodiscard]] std::span<VertexId> own_path(AgentId agent) {
    return std::span(paths_).subspan(agent.index() * kSize, kSize);
  }
  /// Where the counts of a vertex or an edge begin.
  [[nodiscard]] static std::size_t at(std::size_t index) { return index * kSize; }
  [[nodiscard]] std::size_t edge(VertexId from, VertexId to) const;
  void add(std::span<const VertexId> path);
  void remove(std::span<const VertexId> path);
  void search(AgentId agent, VertexId start);
  void push(const Label& label, Timestep left);
  std::optional<LabelIndex> pop();
  void expand(LabelIndex from, const GoalDistances::Row& distances);
  void trace(AgentId agent, LabelIndex last);

  const Instance& instance_;
  const Graph& graph_;
  const GoalDistances& distances_;
  TieBreaker ties_;
  std::vector<VertexId> paths_;                   // By agent, then timestep.
  std::vector<char> is_counted_;                  // By agent: its path is in the counts.
  IdVector<VertexId, std::uint32_t> first_edge_;  // Of a vertex; edges are directed.
  std::vector<std::uint32_t> reverse_;            // By edge.
  std::vector<Count> present_;                    // By vertex, then timestep: paths there.
  std::vector<Count> coming_;                     // By edge, then timestep: moves against it.
  bool is_first_ = true;                          // There are no paths yet.
  std::int64_t effort_ = 0;

  // Of the current search.
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> closed_in_;  // By vertex, then timestep: a search.
  std::vector<Label> labels_;
  std::vector<LabelIndex> buckets_;    // The last label of each.
  std::vector<std::uint64_t> filled_;  // A bit for each bucket.
  std::size_t first_filled_ = 0;       // No word before it has bits.
  Timestep least_left_ = 0;            // Of the way to the goal, at the end of a path.
};

}  // namespace quadrille::discrete
