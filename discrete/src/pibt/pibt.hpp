// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pibt/guidance.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::discrete {

/// Moves all agents by one timestep, by priority inheritance with backtracking (PIBT; Okumura et
/// al., AIJ 2022), with the swap operation of Okumura, "Improving LaCAM for scalable eventually
/// optimal multi-agent pathfinding", IJCAI 2023. Vertices hold one agent and edges are not swapped;
/// following and rotations are allowed.
class Pibt {
 public:
  struct Order {  ///< `agent` has to move to `to`, which is its vertex or a neighbour of it.
    AgentId agent;
    VertexId to;
  };

  /// Which of several vertices an agent tries first that are as near to its goal.
  enum class Ties {
    random,
    /// One that fewest of those beside the agent would like to go to: hindrance, of Okumura and
    /// Nagai, "Lightweight and effective preference construction in PIBT for large-scale
    /// multi-agent pathfinding", SoCS 2025. Then a random one.
    least_wanted,
  };

  /// All outlive this object. `guide` may be null. An agent on its guide's path would like to
  /// follow it most of all; one off it is drawn to the goal by the distances.
  Pibt(const Instance& instance, const GoalDistances& distances, Random& random,
       const Guidance* guide = nullptr, Ties ties = Ties::random);
  /// Of so many agents, whose goals may change between two calls: only the distances count.
  Pibt(const Graph& graph, std::size_t num_agents, const GoalDistances& distances, Random& random,
       const Guidance* guide = nullptr, Ties ties = Ties::random);

  /// Makes `to` a configuration that can follow `from` and obeys the orders; earlier agents in
  /// `priority` choose first. False if it found none, which with orders for all agents means that
  /// they contradict each other. `num_choosing`: all in `priority` after the first so many stay
  /// unless they are pushed. O(agents * degree) as a rule.
  bool advance(std::span<const VertexId> from, std::span<const AgentId> priority,
               std::span<const Order> orders, std::vector<VertexId>& to,
               std::size_t num_choosing = SIZE_MAX);

 private:
  static constexpr std::uint32_t kNobody = UINT32_MAX;
  struct Candidate {
    Timestep distance;
    std::uint32_t num_wanting;
    std::uint64_t tie;
    VertexId vertex;
  };
  /// An agent that is looking for its next vertex; those after it on the stack were pushed by it.
  struct Frame {
    AgentId agent;
    std::size_t first;  // Of its candidates; they end where those of the next frame begin.
    std::size_t next;   // The candidate to be tried next.
    std::uint32_t partner;
  };

  bool obey(std::span<const Order> orders);
  bool place(AgentId agent);
  void push_frame(AgentId agent);
  void move(AgentId agent, VertexId to);
  void pull_partner(const Frame& frame);
  [[nodiscard]] std::uint32_t num_wanting(VertexId to, VertexId centre) const;
  [[nodiscard]] std::uint32_t swap_partner(AgentId agent, VertexId best) const;
  [[nodiscard]] bool has_to_swap(AgentId pusher, AgentId puller, VertexId pusher_at,
                                 VertexId puller_at) const;
  [[nodiscard]] bool can_swap(VertexId pusher_at, VertexId puller_at) const;
  struct Continuation {
    std::size_t ways = 0;
    VertexId vertex;
  };
  [[nodiscard]] Continuation continuation(VertexId at, VertexId behind) const;
  void reset();

  const Graph& graph_;
  const GoalDistances& distances_;
  Random& random_;
  const Guidance* const guide_;
  const Ties ties_;
  std::span<const VertexId> from_;
  std::vector<VertexId>* to_ = nullptr;
  std::vector<char> decided_;                             // By agent.
  IdVector<VertexId, std::uint32_t> occupant_, claimer_;  // Now and at the next timestep.
  std::vector<Frame> stack_;
  std::vector<Candidate> candidates_;
};

}  // namespace quadrille::discrete
