// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/member.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

using quadrille::MemberId;

/// A roadmap and agents that change, and are solved again after each change. What the answers rest
/// on lives on: what is in whose way, the distances to goals, the lower bounds of groups of agents
/// of whom nothing has changed, the last plans, which are mended instead of made anew, and lemmas
/// and cores of the last search by clauses (docs/soundness/sessions.md). Costs and proofs are
/// those of `solve` for `instance()`; among plans of the same cost it may be another one, which
/// depends on what was solved before.
///
/// For one thread at a time; several sessions may solve at once. Memory: contacts of all moves that
/// searches have come to, the last 16 answers, and up to 3,000 lemmas and as many cores.
class Session {
 public:
  /// Requires a roadmap. The rest is as in Instance::make; `whole_moves`: with_whole_moves.
  explicit Session(std::shared_ptr<const Roadmap> roadmap, Resolution resolution = {},
                   std::vector<MovingObstacle> obstacles = {}, Ticks now = 0,
                   bool whole_moves = false);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  // Changes. One that is refused changes nothing. Whether agents are in each other's way, or can
  // reach their goals, is found out when it is solved: between two changes they need not.

  /// Errors: invalid_instance for a vertex that does not exist, or an agent that is under way, see
  /// put_under_way.
  [[nodiscard]] Result<MemberId> add(const Agent& agent);
  /// All of these: invalid_instance if there is no such member.
  [[nodiscard]] std::optional<Error> remove(MemberId member);
  /// Another start, goal, body, or whatever else. Errors as for add.
  [[nodiscard]] std::optional<Error> change(MemberId member, const Agent& agent);
  /// The member begins in the middle of a move along the edge, of which it has `behind` ticks
  /// behind it, and finishes the move without a stop. Its place is the point of the edge that many
  /// ticks from its tail, exactly. In instances and plans that is a vertex after those of the
  /// roadmap. A closed edge will do. Errors: invalid_instance
  /// for an edge that does not exist or is not for the member's group; out_of_range for `behind`
  /// outside [0, duration).
  [[nodiscard]] std::optional<Error> put_under_way(MemberId member, EdgeId edge, Ticks behind);
  /// Other goals, from where it is. Errors as for add.
  [[nodiscard]] std::optional<Error> assign(MemberId member, const Goals& goals);
  /// Time has gone on until the tick `now`, and everybody has followed the plan, one of
  /// `instance()` (that of the last answer, or what has become of it where somebody was late). From
  /// now on members begin where they are then: at a vertex, or under way on an edge; members that
  /// leave and have arrived are removed. What was learned is learned of what is left of their ways.
  /// Errors: out_of_range for a `now` that is over; those of instance(); invalid_plan, with the
  /// first violation, if `verify` finds any.
  [[nodiscard]] std::optional<Error> advance_to(Ticks now, const Plan& plan);
  /// For everybody, until it is opened. Errors: invalid_instance if there is no such edge, or it is
  /// closed (open) already.
  [[nodiscard]] std::optional<Error> close(EdgeId edge);
  [[nodiscard]] std::optional<Error> open(EdgeId edge);

  /// In the order in which they were added, which is that of agents in instances and plans.
  [[nodiscard]] std::vector<MemberId> members() const;
  /// Requires a member. Of one that is under way, the start is the tail of its edge.
  [[nodiscard]] const Agent& agent(MemberId member) const;
  [[nodiscard]] bool is_closed(EdgeId edge) const;

  /// Until when time has gone on.
  [[nodiscard]] Ticks now() const noexcept;
  /// As things are now. Edges that are closed are open to no group; ids are those of the roadmap.
  /// Errors: those of Instance::make.
  [[nodiscard]] Result<Instance> instance() const;

  /// As continuous::solve for `instance()`. Errors: those of both. With one thread the search takes
  /// note of what the lower bound is made of, as with `explain`, which costs a few per cent of its
  /// time. What is thrown leaves the session as it was.
  [[nodiscard]] Result<SolveOutcome> solve(const SolveOptions& options);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace quadrille::continuous

QUADRILLE_API_END
