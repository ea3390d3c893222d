// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_set>
#include <vector>

#include "pibt/pibt.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// Searches configurations (the vertices of all agents at one timestep) timestep by timestep, and
/// goes on from the best ones of each only: those whose agents are nearest to their goals, in sum.
/// Some successors of each come from PIBT with priorities drawn at random. Again and again, with
/// twice as many each time, until that brings no cheaper plan. For small boards that are nearly
/// full: there each agent has few places to go to, PIBT turns many cycles at once, and what matters
/// is which of them. One thread.
///
/// Beam search: Lowerre, "The Harpy speech recognition system", 1976.
class BeamSearch {
 public:
  /// Whether it has a chance to find something. O(agents).
  [[nodiscard]] static bool is_worth_trying(const Instance& instance,
                                            const GoalDistances& distances);

  /// `instance` outlives the object. Requires that goals can be reached.
  BeamSearch(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
             std::uint32_t seed);
  BeamSearch(const BeamSearch&) = delete;
  BeamSearch& operator=(const BeamSearch&) = delete;

  /// Searches on until `effort` more is spent, a limit is met or it is over.
  void advance(std::int64_t effort, LimitMonitor& limits);
  [[nodiscard]] bool is_over() const noexcept { return is_over_ || effort_ >= kMostEffort; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }
  /// The one of least sum of costs so far, trimmed; nullopt if there is none.
  [[nodiscard]] const std::optional<Plan>& plan() const noexcept { return plan_; }

 private:
  using NodeIndex = std::size_t;
  static constexpr NodeIndex kNone = SIZE_MAX;
  /// Some 0.5 s.
  static constexpr std::int64_t kMostEffort = 2'500'000;
  /// Measured on 25 boards of 4 x 4 and 25 of 5 x 5, 81 to 96 % full, sums of costs: 16, 32 and 64
  /// successors 5,042, 4,989 and 5,138; with a first width of 64 and 32 successors 4,989. By what a
  /// plan costs at least instead of what is left: 5,506. One seed, and all rounds made to the end
  /// of the effort; the first four are within what noise may do.
  static constexpr std::size_t kFirstWidth = 16, kSuccessors = 32;

  struct Candidate {
    Cost left;   // Moves to the goals, in sum.
    Cost least;  // Of what a plan by way of it costs.
    NodeIndex parent;
    std::size_t at;  // In configurations_of_next_.
  };

  void begin_round();
  void expand(NodeIndex node);
  void set_priorities(std::span<const VertexId> configuration);
  void consider(NodeIndex parent);
  void end_layer();
  void offer(NodeIndex parent);
  [[nodiscard]] std::span<const VertexId> configuration(NodeIndex node) const {
    return std::span(configurations_).subspan(node * num_agents_, num_agents_);
  }

  const Instance& instance_;
  const std::shared_ptr<const GoalDistances> distances_;
  const std::size_t num_agents_;
  Random random_;
  Pibt pibt_;
  std::optional<Plan> plan_;
  Cost cost_ = 0;
  bool is_over_ = false;  // Wider rounds would not see more.
  std::int64_t effort_ = 0;

  // Of the current round.
  std::size_t width_ = kFirstWidth;
  bool has_found_ = false;
  bool is_cheaper_ = false;  // What it has found is cheaper than what was found before.
  bool was_cut_ = false;     // Some layer had more configurations than it was to go on with.
  Timestep depth_ = 0;       // Of the layer.
  std::vector<VertexId> configurations_;  // By node, then agent.
  std::vector<NodeIndex> parents_;        // By node.
  NodeIndex layer_next_ = 0;              // Of the layer, which goes on to the last node.
  std::vector<VertexId> configurations_of_next_;
  std::vector<Candidate> next_;
  std::unordered_set<std::uint64_t> seen_;  // Only looked up, never walked.
  // Scratch.
  std::vector<std::uint64_t> draws_;
  std::vector<AgentId> priority_;
  std::vector<VertexId> successor_;
};

}  // namespace quadrille::discrete
