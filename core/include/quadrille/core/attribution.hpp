// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/outcome.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What an agent costs. In timesteps or ticks, as everything below.
struct AgentCharge {
  Cost free_cost = 0;        ///< Of its cheapest path when it is alone.
  std::optional<Cost> cost;  ///< In the plan; absent if there is no plan.
};

/// What a raise follows from.
enum class RaiseKind : std::uint8_t {
  core,    ///< One unsatisfiable core.
  cover,   ///< Several cores together, more than the sum of what each gives (continuous time).
  search,  ///< A search for plans of these agents, without cores (continuous time, few agents).
  total,   ///< A refuted bound on what all agents cost together.
};
[[nodiscard]] std::string_view to_string(RaiseKind kind) noexcept;  ///< "core" | "cover" | ...

/// One step of the lower bound. What is claimed, see `Attribution`, is about `agents` and
/// `bystanders` alone, whatever the others do.
struct Raise {
  RaiseKind kind = RaiseKind::core;
  Cost amount = 0;              ///< At least 1.
  std::vector<AgentId> agents;  ///< Who costs more; increasing, not empty.
  /// Who may be needed besides, because the proof may use where these are, or that they cannot go
  /// any way round: increasing, none of `agents`. More of them than necessary may be named.
  std::vector<AgentId> bystanders;
};

/// Where two agents are in each other's way.
struct Place {
  enum class Kind : std::uint8_t {
    vertex,     ///< `from`. `to` is the same.
    edge,       ///< Between `from` and `to`, in either direction.
    corridor,   ///< Both pass it from end to end, in opposite directions: `from` and `to` are ends.
    rectangle,  ///< Both cross it, on a grid: `from` and `to` are opposite corners.
    goal,       ///< `from` is where the second agent is at rest and the first one passes.
    crossing,   ///< The first agent's edge; that of the second is another one (continuous time).
  };
  Kind kind = Kind::vertex;
  VertexId from, to;
  friend auto operator<=>(const Place&, const Place&) = default;
};
[[nodiscard]] std::string_view to_string(Place::Kind kind) noexcept;  ///< "vertex" | "edge" | ...

/// Collision lemmas about two agents and a place, whose times overlap or follow each other without
/// a gap. The solver makes one whenever paths that it looks at collide: many of them, over a long
/// time, are a bottleneck. They are no proof by themselves.
struct CollisionSite {
  /// `end` if the second agent never leaves (Place::Kind::goal).
  static constexpr Cost kForever = std::numeric_limits<Cost>::max();
  AgentId first, second;  ///< Unless the place is a goal or a crossing, first < second.
  Place place;
  std::optional<Place> other;   ///< Of a crossing: the second agent's edge.
  Cost begin = 0, end = 0;      ///< From `begin` to before `end`; begin < end.
  std::int64_t num_lemmas = 1;  ///< At least 1.
};

/// Why no plan is cheaper: what the proven lower bound of a solve is made of.
///
/// Sum of costs. `lower_bound` is `free_bound`, the sum of the free costs, plus the amounts of all
/// raises. Each part of that can be checked alone. Let H be a set of agents. In every plan of the
/// agents H, as if there were no others, these cost at least the sum of their free costs plus the
/// amounts of all raises whose agents and bystanders are in H.
///
/// Makespan. `free_bound` is the largest free cost, `lower_bound` is that plus the amounts of all
/// raises, and these come in order: let H contain the agents and bystanders of raise k, then the
/// makespan of every plan of H is at least `free_bound` plus the amounts of the raises up to and
/// with k. So the last one says it all.
///
/// A raise of kind `total` names all agents. Why the claims hold: docs/soundness/cost.md.
struct Attribution {
  Objective objective = Objective::sum_of_costs;
  Cost free_bound = 0;
  Cost lower_bound = 0;  ///< As in the outcome.
  IdVector<AgentId, AgentCharge> agents;
  std::vector<Raise> raises;  ///< In the order in which they were proved.
  /// By place, then agents, then time. Empty if no collision lemma was needed.
  std::vector<CollisionSite> sites;
};

/// Sites in the order of `Attribution::sites`, those of the same agents and places whose times
/// overlap or meet as one. O(n log n).
[[nodiscard]] std::vector<CollisionSite> merged(std::vector<CollisionSite> sites);

/// Makes the sum of the raises what the bound needs: cuts the last ones if they amount to more
/// (smaller claims follow from larger ones), or adds one of kind `total` if they amount to less.
/// Requires lower_bound >= free_bound, and an agent if they differ.
void fit_to_bound(Attribution& attribution);

}  // namespace quadrille

QUADRILLE_API_END
