// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/sat/lit.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// A problem whose plans are the models of an engine's clauses. Assumptions bound what they cost:
/// in all, or agent by agent. An agent whose cost no assumption bounds is *absent*: it need not
/// have a path, and nobody collides with it.
///
/// "No plan" and "every plan" below mean all plans: cores that hold only relative to an incumbent
/// do not belong among the clauses of such an engine.
class CostProblem {
 public:
  virtual ~CostProblem() = default;

  [[nodiscard]] virtual std::size_t num_agents() const = 0;
  /// Cost of the agent's cheapest path when it is alone.
  [[nodiscard]] virtual Cost free_cost(AgentId agent) const = 0;
  /// Adds what paths of the agent that cost up to `cost` need. False if `limits` ended that early.
  /// Not during solve.
  [[nodiscard]] virtual bool grow_to(AgentId agent, Cost cost, LimitMonitor& limits) = 0;
  /// The literal "the agent costs more than `cost`", implied by those for larger costs. Requires
  /// cost >= free_cost and that the problem has grown to it. Not during solve.
  [[nodiscard]] virtual Lit cost_above(AgentId agent, Cost cost) = 0;

  /// What plans pay besides what agents cost: `amount` >= 1 where `due` is true.
  struct Fee {
    Lit due;
    Cost amount = 1;
  };
  /// All that there are, each literal once; the same ones at each call.
  [[nodiscard]] virtual std::span<const Fee> fees() const { return {}; }

  /// No plan is cheaper.
  [[nodiscard]] virtual Cost lower_bound() const = 0;
  /// Appends assumptions that hold only in plans that cost at most `bound`, after adding the
  /// clauses that such plans need. They may be stronger than that at first: `next_bound` weakens
  /// them. Retracts nothing. False if `limits` ended that early.
  [[nodiscard]] virtual bool assume_at_most(Cost bound, LimitMonitor& limits,
                                            std::vector<Lit>& assumptions) = 0;
  /// The assumptions in `core`, some of those for `bound`, cannot hold together. Returns a larger
  /// bound that no plan is below; or `bound` itself if the core only shows that the assumptions
  /// were stronger than need be, and the next ones for `bound` will be weaker.
  [[nodiscard]] virtual Cost next_bound(Cost bound, std::span<const Lit> core) = 0;

  /// Called before each solve. `all_present`: the assumptions bound every agent's cost, one by one
  /// or all together.
  virtual void on_solve(bool all_present) = 0;
  /// Whose costs the assumptions in `core` bound, some of those of `assume_at_most`; increasing.
  [[nodiscard]] virtual std::vector<AgentId> agents_of(std::span<const Lit> /*core*/) const {
    std::vector<AgentId> all;
    for (const AgentId i : IdRange<AgentId>(num_agents())) all.push_back(i);
    return all;
  }
  /// Looks at the engine's model for all agents. False: it is no plan, or one that pays a fee whose
  /// literal is false in the model; clauses that exclude it were added.
  [[nodiscard]] virtual bool accept_model() = 0;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
