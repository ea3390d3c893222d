// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// Changes the paths of a few agents at a time, for fleets whose tasks change all the time. What is
/// known of the roadmap lives on: in whose way moves and places are, how far it is to goals.
///
/// Agents are sent to goals one after the other, each by a cheapest path around all others, which
/// keep theirs (safe-interval path planning, Phillips and Likhachev 2011, ICRA). Where there is
/// none, those that are in the way on its way alone give up their paths, and find others after it,
/// or places where they may stand (large neighbourhoods, Li et al. 2021, IJCAI). Proves nothing.
/// Deterministic: counts effort. One thread at a time.
class Replanner {
 public:
  /// Requires a roadmap.
  explicit Replanner(std::shared_ptr<const Roadmap> base);
  ~Replanner();
  Replanner(Replanner&&) noexcept;
  Replanner& operator=(Replanner&&) noexcept;

  /// What follows is about these agents. The goals of the instance are where agents are to go. The
  /// plan has a path for each, which need not end at one of these; nobody collides in it. Requires
  /// the vertices and edges of the base in the roadmap of the instance, which may have more after
  /// them, no moving obstacles, and such a plan. `limits`: what the following calls may use; when
  /// they are met nothing more changes. Effort counts from here.
  void begin(const Instance& instance, const Plan& plan, const Limits& limits = {});

  /// Who may be asked to give way: it gets a path to a goal of its own if its path leads to one and
  /// there is one, else to a place where it may stay.
  using MayPush = std::function<bool(AgentId)>;
  /// Gives the agent a path to one of its goals. False if none was found; then all paths are what
  /// they were. Without `may_push` the others keep their paths. Requires `begin`.
  bool send(AgentId agent, const MayPush& may_push = {});
  /// Makes the paths of some agents cheaper, whose goals are the ends of the paths that they have;
  /// for about `effort`. True if the plan is cheaper now.
  bool improve(Effort effort);

  /// As it is now: paths of agents for whom nothing was changed are as they were given.
  [[nodiscard]] Plan plan() const;
  /// Whose path ends at one of its goals.
  [[nodiscard]] bool arrives(AgentId agent) const;
  /// Since `begin`.
  [[nodiscard]] Effort effort() const;
  /// The agent's free cost: what the cheapest path from its start to a goal costs on an empty
  /// roadmap, from the instance's `now` on.
  [[nodiscard]] Cost free_cost(AgentId agent) const;

 private:
  class Parts;
  class Round;
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
