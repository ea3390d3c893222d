// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/member.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/discrete/solver.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::discrete {

using quadrille::MemberId;

/// A graph and agents that change, and are solved again after each change. What the answers rest on
/// lives on: the lower bounds of groups of agents of whom nothing has changed, and the last plans,
/// which are mended instead of made anew (docs/soundness/sessions.md). Lemmas are not kept. Costs
/// and proofs are those of `solve` for `instance()`; among plans of the same cost it may be another
/// one, which depends on what was solved before.
///
/// For one thread at a time; several sessions may solve at once. Memory: the last 16 answers.
class Session {
 public:
  /// Requires a graph. The rest is as in Instance::make, which sees to what is wrong with it.
  explicit Session(std::shared_ptr<const Graph> graph, Timestep now = 0, Rules rules = {});
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  // Changes. One that is refused changes nothing. Whether agents are in each other's way, or can
  // reach their goals, is found out when it is solved: between two changes they need not.

  /// Errors: invalid_instance for a vertex that does not exist, or an agent without a goal.
  [[nodiscard]] Result<MemberId> add(const Agent& agent);
  /// All of these: invalid_instance if there is no such member.
  [[nodiscard]] std::optional<Error> remove(MemberId member);
  /// Another start, goal, or whatever else. Errors as for add.
  [[nodiscard]] std::optional<Error> change(MemberId member, const Agent& agent);
  /// Other goals, from where it is. Errors as for add.
  [[nodiscard]] std::optional<Error> assign(MemberId member, const Goals& goals);
  /// Time has gone on until the timestep `now`, and everybody has followed the plan, one of
  /// `instance()` (that of the last answer, or what has become of it where somebody was late). From
  /// now on members begin where they are then; waypoints that they have visited are theirs no more;
  /// members that leave and have arrived are removed. Errors: out_of_range for a `now` that is
  /// over, and where turns take time, as plans do not say how far somebody has turned; those of
  /// instance(); invalid_plan, with the first violation, if `verify` finds any.
  [[nodiscard]] std::optional<Error> advance_to(Timestep now, const Plan& plan);
  /// Nobody may be in the vertex, or go along the edge in either direction, until it is opened: a
  /// blockage of the instance, without end. Errors: invalid_instance if there is no such vertex or
  /// edge, or it is closed (open) already.
  [[nodiscard]] std::optional<Error> close(VertexId vertex, std::optional<VertexId> to = {});
  [[nodiscard]] std::optional<Error> open(VertexId vertex, std::optional<VertexId> to = {});

  /// In the order in which they were added, which is that of agents in instances and plans.
  [[nodiscard]] std::vector<MemberId> members() const;
  /// Requires a member.
  [[nodiscard]] const Agent& agent(MemberId member) const;
  [[nodiscard]] bool is_closed(VertexId vertex, std::optional<VertexId> to = {}) const;

  /// Until when time has gone on.
  [[nodiscard]] Timestep now() const noexcept;
  /// As things are now. Errors: those of Instance::make.
  [[nodiscard]] Result<Instance> instance() const;

  /// As discrete::solve for `instance()`. Errors: those of both. Of agents without rules, with the
  /// system dpll, for the sum of costs, the search takes note of what the lower bound is made of,
  /// as with `explain`. With `proof` no bound of earlier answers is used, as a certificate does not
  /// know them. What is thrown leaves the session as it was.
  [[nodiscard]] Result<SolveOutcome> solve(const SolveOptions& options);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::discrete

QUADRILLE_API_END
