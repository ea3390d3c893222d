// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "paths/agent_distances.hpp"
#include "paths/path_index.hpp"

namespace quadrille::discrete {

/// The chains of vertices with two neighbours, in which agents cannot pass each other, and what
/// follows for two agents that meet in one (Li et al. 2020, ICAPS). There are none where edges lead
/// one way: inside, agents may have other ways.
class Corridors {
 public:
  /// `graph` outlives the object. O(V).
  explicit Corridors(const Graph& graph);

  /// Whether it is one of a chain, and none of its ends.
  [[nodiscard]] bool is_inside(VertexId v) const { return corridor_of_[v] != kNone; }

  /// An agent's use of an end of a corridor in a range of time.
  struct Exit {
    AgentId agent;
    VertexId vertex;
    Timestep first = 0, last = 0;
  };
  /// The exits of two agents whose paths meet in a corridor; nullopt if one does not pass it from
  /// end to end, both go the same way, or a path is late enough for the other one to pass first. No
  /// two paths of the agents that both use their exits are free of collisions; the current ones do.
  [[nodiscard]] std::optional<std::pair<Exit, Exit>> find(const AgentDistances& first,
                                                          const AgentDistances& second,
                                                          const PathIndex& paths,
                                                          const Encounter& conflict);

 private:
  struct Corridor {
    std::array<VertexId, 2> ends;
    std::vector<VertexId> inner;  // from ends[0] to ends[1]
  };
  struct Passage {
    std::size_t exit;  // index of the end
    Timestep arrival;  // there
  };
  void add_corridor(VertexId seed);
  [[nodiscard]] std::optional<Passage> find_passage(const Path& path, std::size_t corridor,
                                                    Timestep inside) const;
  /// When the agent can be at an end at the earliest without passing the corridor.
  [[nodiscard]] Timestep detour(AgentId agent, const AgentDistances& distances,
                                std::size_t corridor, std::size_t end);

  static constexpr std::size_t kNone = SIZE_MAX;
  const Graph& graph_;
  std::vector<Corridor> corridors_;
  IdVector<VertexId, std::size_t> corridor_of_;  // of inner vertices
  std::map<std::pair<AgentId, std::size_t>, std::array<Timestep, 2>> detours_;
};

}  // namespace quadrille::discrete
