// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/graph.hpp"
#include "quadrille/discrete/plan.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

struct RollingOptions {
  /// Timesteps that are planned ahead, at least 1.
  Timestep window = 20;
  std::uint64_t seed = 0;
  /// Whether groups of agents get cheaper paths, once everybody who was sent somewhere has one.
  bool improves = true;
};

/// Plans for fleets on graphs, timestep by timestep, whose goals change all the time: paths for the
/// next timesteps (a window, as in RHCR of Li et al., AAAI 2021), which never collide.
///
/// When time goes on, the window gets one timestep more by PIBT (Okumura et al., AIJ 2022), which
/// always finds one; whoever was sent somewhere gets a cheapest path around all others; then groups
/// of agents that are in each other's way get cheaper paths (large neighbourhood search, as WPPL of
/// Jiang et al., SoCS 2024). Effort is counted, so that the same calls give the same paths. Agents
/// that are held up keep the order of the visits to each vertex, so that nobody collides and nobody
/// else is stuck. For one thread at a time.
class RollingPlanner {
 public:
  /// All are in vertices of their own, and have nothing to do: they only get out of the way.
  /// Requires a graph, and such vertices. Memory: agents * vertices * 2 bytes, or a quarter of that
  /// where that is large (GoalDistances), and window * vertices * 12.
  RollingPlanner(std::shared_ptr<const Graph> graph, std::span<const VertexId> places,
                 const RollingOptions& options = {});
  ~RollingPlanner();
  RollingPlanner(RollingPlanner&&) noexcept;
  RollingPlanner& operator=(RollingPlanner&&) noexcept;

  /// Instead of what it was about. It stays for `service` timesteps at the first of the goals that
  /// it comes to. Of two agents that want the same place where nothing else decides, the one of the
  /// lesser rank gets it. Requires goals that it can reach, and a service of at least 0. O(graph).
  void send(AgentId agent, const Goals& goals, Timestep service, std::int64_t rank);
  /// It has nothing to do any more.
  void release(AgentId agent);

  /// Edges have been closed, or opened: all paths are made anew, by the next call of `plan` or
  /// `advance`. Requires the same vertices, and that everybody who was sent somewhere and is not
  /// there can reach it. O(agents * graph).
  void set_graph(std::shared_ptr<const Graph> graph);

  /// Makes the window whole, and looks for better paths for about `effort`, or until limits are
  /// met; PIBT is not counted. The effort that it took.
  Effort plan(Effort effort, const Limits& limits = {});
  /// A timestep. Those in `held` stay where they are; so do those that have to wait for them.
  /// Whoever has been held up n times on end is taken to be so n times more.
  void advance(std::span<const AgentId> held = {});

  [[nodiscard]] std::size_t num_agents() const noexcept;
  /// Timesteps that are over.
  [[nodiscard]] Timestep now() const noexcept;
  [[nodiscard]] VertexId place(AgentId agent) const;
  /// Where it is now, and after each timestep of the window.
  [[nodiscard]] Path path(AgentId agent) const;
  /// It has been sent somewhere, has been there and stayed for as long as it should.
  [[nodiscard]] bool is_done(AgentId agent) const;
  /// It was sent somewhere and will be there in the window.
  [[nodiscard]] bool arrives(AgentId agent) const;
  /// Timesteps until it arrives, if it does; 0 if it has. Else until the end of the window, and the
  /// way from there that it would have if it were alone. 0 for who has nothing to do.
  [[nodiscard]] Timestep cost(AgentId agent) const;
  /// The same if it were alone from now on, and not held up. Never more.
  [[nodiscard]] Timestep free_cost(AgentId agent) const;

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
