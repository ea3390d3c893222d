// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lazy/common_end.hpp"
#include "lazy/lazy_model.hpp"
#include "mdd/mdd_paths.hpp"
#include "quadrille/core/settings.hpp"

namespace quadrille::discrete {

/// Gives an agent of the lazy model explicit paths, the clauses of its MDD over X(v,t), once it has
/// cost enough path lemmas for the number of these variables: in mazes and on small, crowded maps
/// the cuts that refute a bound are too many to be listed, and resolution over X(v,t) finds short
/// proofs.
///
/// X(v,t) implies all usage literals of obstacles that (v,t) is part of, so the explicit paths keep
/// off all that the theory's paths keep off. All clauses hold in every plan: they are redundant.
/// The paths of an agent that may end in several states, or at a price, lead to a common end.
class ExplicitPaths {
 public:
  /// As many `variables` are worth as many path `lemmas`, at least 1. No variables: no explicit
  /// paths. An agent has `first_look` lemmas before they are considered.
  struct Price {
    std::int64_t variables = Settings().explicit_variables, lemmas = Settings().explicit_lemmas;
    std::int64_t first_look = 64;
  };
  /// `model` outlives this.
  ExplicitPaths(LazyModel& model, Price price)
      : model_(model), price_(price), agents_(model.instance().num_agents()) {}

  /// To be called for each path lemma, with the largest cost that the agent may have at present.
  void on_path_lemma(AgentId agent, Timestep cap, FormulaWriter& writer);
  /// To be called when obstacles were added to the model.
  void link_new_obstacles(FormulaWriter& writer);

 private:
  struct Agent {
    std::int64_t num_lemmas = 0;
    std::int64_t next_look = 0;         // number of lemmas
    std::optional<MddPaths> paths;      // absent: not explicit
    std::optional<CommonEnd> common;    // absent: it has one end
    std::vector<ObstacleId> obstacles;  // of this agent
  };
  class AgentFormula;

  // Delays count from the length of the way to the goal, as those of MddPaths do.

  [[nodiscard]] std::int64_t size(AgentId agent, Timestep max_delay) const;
  void make_paths(AgentId agent);
  [[nodiscard]] const Graph& graph(AgentId agent) const;
  /// X is false where rules forbid to be, for X beyond the delay `old_cap`.
  void add_bans(AgentId agent, Timestep old_cap, FormulaWriter& writer);
  /// Of an agent that leaves: "it arrives before `t`", for its goal, where X stays true when it is
  /// gone. Invalid: X means by itself that it is there.
  [[nodiscard]] sat::Lit gone(AgentId agent, VertexId state, Timestep t, FormulaWriter& writer);
  /// Being at rest implies what the obstacle's literal says, likewise, for an agent with a common
  /// end.
  void link_rests(AgentId agent, const Obstacle& obstacle, Timestep old_cap, FormulaWriter& writer);
  /// X implies what the obstacle's literal says, for X beyond the delay `old_cap`.
  void link(AgentId agent, ObstacleId id, Timestep old_cap, FormulaWriter& writer);

  LazyModel& model_;
  const Price price_;
  IdVector<AgentId, Agent> agents_;
  std::size_t num_linked_ = 0;  // obstacles
};

}  // namespace quadrille::discrete
