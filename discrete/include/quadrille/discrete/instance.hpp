// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/goals.hpp"
#include "quadrille/core/heading.hpp"
#include "quadrille/discrete/graph.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

/// The latest timestep at which an instance may begin.
inline constexpr Timestep kMaxNow = 1'000'000'000;

/// The times of rules lie less than this many timesteps after Instance::now.
inline constexpr Timestep kMaxRuleTime = 1 << 20;

/// The most timesteps that a quarter turn may take.
inline constexpr Timestep kMaxTurn = 16;

/// Where an agent begins, and where it may end: it stays for ever at any one of its goals. And the
/// rules that it alone obeys, whose timesteps are absolute.
struct Agent {
  VertexId start;
  Goals goals;  ///< At least one.
  /// It begins no move before this timestep. At its start it is from Instance::now on all the same,
  /// and its cost counts from there.
  Timestep release = 0;
  /// It arrives at its goal for the last time by this timestep.
  std::optional<Timestep> deadline = {};
  /// It vanishes when it arrives at its goal, where the goals of others may be, too: at that
  /// timestep it is in the way, and never again. Otherwise it stays there for ever.
  bool leaves = false;
  /// Vertices that it has to visit before it ends, in this order. Its start and its goal count.
  std::vector<VertexId> waypoints = {};
  /// Where it faces at its start; means something where turns take time.
  Heading heading = Heading::east;

  /// Requires that there is one goal only.
  [[nodiscard]] VertexId goal() const { return goals.only(); }
  friend bool operator==(const Agent&, const Agent&) = default;
};

/// A vertex that nobody may be in, or an edge that nobody may move along, at some timesteps: of an
/// obstacle whose way is known.
struct Blockage {
  VertexId vertex;
  /// The other end of the edge, in either direction. Absent: the vertex is blocked.
  std::optional<VertexId> to = {};
  /// The first and the last timestep at which somebody is not there, or does not begin the move.
  Timestep first = 0;
  std::optional<Timestep> last = {};  ///< Absent: for ever.
  friend bool operator==(const Blockage&, const Blockage&) = default;
};

/// The rules that all agents obey.
struct Rules {
  std::vector<Blockage> blockages;
  /// k: nobody is in a vertex within k timesteps after another agent was in it. 1 forbids to follow
  /// another agent closely. 0: agents may follow.
  Timestep robust = 0;
  /// On grids, for robots that turn: timesteps of a quarter turn. An agent moves ahead only, and
  /// turns where it is, as early as it likes; where it faces in the end is nothing to anybody. 0:
  /// agents have no headings.
  Timestep turn = 0;
  friend bool operator==(const Rules&, const Rules&) = default;
};

/// A classic MAPF instance: a graph and the agents on it, which are at their starts at the timestep
/// `now`, 0 if nothing else is said. All timesteps of its plans are absolute, and what they cost
/// counts from `now`. Immutable; cheap to copy (the graph is shared).
class Instance {
 public:
  /// Errors: invalid_instance for a vertex out of range, an agent without a goal, two agents with
  /// the same start, two agents that stay at the same goal and have no other one, a blocked edge
  /// that does not exist or a blockage that ends before it begins; out_of_range for `now` outside
  /// [0, kMaxNow], times of rules that are negative or kMaxRuleTime or more after `now`, and
  /// `robust` outside [0, kMaxRuleTime), and `turn` outside [0, kMaxTurn]; invalid_instance for
  /// turns on graphs that are no grid. Sets of several goals may overlap. Agents are named by their
  /// index in the message. No agents are allowed. O(V + all goals + rules).
  [[nodiscard]] static Result<Instance> make(std::shared_ptr<const Graph> graph,
                                             std::vector<Agent> agents, Timestep now = 0,
                                             Rules rules = {});
  [[nodiscard]] static Result<Instance> make(Graph graph, std::vector<Agent> agents,
                                             Timestep now = 0, Rules rules = {});
  /// The same with other agents. Errors as those of `make`.
  [[nodiscard]] Result<Instance> with_agents(std::vector<Agent> agents) const;
  /// The same with other rules for all. Errors as those of `make`.
  [[nodiscard]] Result<Instance> with_rules(Rules rules) const;
  /// The same, but begun at another timestep. Errors: out_of_range. O(agents).
  [[nodiscard]] Result<Instance> with_now(Timestep now) const;
  /// The same in timesteps that count from `now`. O(agents + rules).
  [[nodiscard]] Instance since_now() const;
  /// The same without any rule that is in `make` and in no classic instance, in timesteps that
  /// count from `now`, and without the agents that leave. If this has no plan, neither has the
  /// instance: of a plan there, what the other agents do is one here. O(V + E + agents).
  [[nodiscard]] Instance relaxed() const;

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }
  [[nodiscard]] std::shared_ptr<const Graph> shared_graph() const noexcept { return graph_; }
  [[nodiscard]] const IdVector<AgentId, Agent>& agents() const noexcept { return agents_; }
  [[nodiscard]] std::size_t num_agents() const noexcept { return agents_.size(); }
  [[nodiscard]] IdRange<AgentId> agent_ids() const noexcept {
    return IdRange<AgentId>(num_agents());
  }
  /// Where turns take time: a directed graph with several vertices, the poses, for each of the
  /// graph's; null elsewhere. The pose k * V + v is in the vertex v. For k < 4 a robot faces there
  /// as kHeadings[k] says; for k = 4 it has come there and stays for ever, whatever it faces; for
  /// larger k it is in the middle of a turn.
  [[nodiscard]] const std::shared_ptr<const Graph>& poses() const noexcept { return poses_; }
  /// The timestep at which all agents are at their starts.
  [[nodiscard]] Timestep now() const noexcept { return now_; }
  [[nodiscard]] const Rules& rules() const noexcept { return *rules_; }
  /// No rules: all edges lead both ways, nothing is blocked, agents may follow each other, turns
  /// take no time, and each of them sets out when it likes, visits what it likes, and stays at its
  /// goal for ever.
  [[nodiscard]] bool is_plain() const noexcept { return is_plain_; }
  /// Some agent has more than one goal.
  [[nodiscard]] bool has_goal_sets() const noexcept { return has_goal_sets_; }

 private:
  Instance(std::shared_ptr<const Graph> graph, IdVector<AgentId, Agent> agents, Timestep now,
           std::shared_ptr<const Rules> rules, std::shared_ptr<const Graph> poses);
  std::shared_ptr<const Graph> graph_, poses_;
  IdVector<AgentId, Agent> agents_;
  Timestep now_;
  std::shared_ptr<const Rules> rules_;
  bool has_goal_sets_, is_plain_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
