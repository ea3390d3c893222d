// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "mdd/mdd.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/sat/lit.hpp"

namespace quadrille::discrete {

/// The clauses over X(v,t), "the agent is in v at t", that make one agent walk through its MDD
/// (docs/soundness/mdd.md). Grows with the delay that the agent may have; every clause stays valid
/// when it does.
class MddPaths {
 public:
  /// Where the clauses go, and what the agent's delays are called there.
  class Formula {
   public:
    virtual ~Formula() = default;
    [[nodiscard]] virtual sat::Lit new_vertex(VertexId v, Timestep t) = 0;
    /// "The agent has a delay of at least `delay`", delay >= 1; made if need be.
    [[nodiscard]] virtual sat::Lit delay_at_least(Timestep delay) = 0;
    /// "The agent ends at `goal`", one of several; asked of no other agents.
    [[nodiscard]] virtual sat::Lit end_at(VertexId /*goal*/) { return {}; }
    virtual void add(std::span<const sat::Lit> clause) = 0;
    /// Whether being elsewhere late has to imply a delay literal.
    [[nodiscard]] virtual bool charges_delays() const = 0;
  };

  /// Requires a reachable goal. O(V + E).
  MddPaths(const Graph& graph, const Agent& task) : mdd_(graph, task) {}

  /// Lets the agent have a delay of up to `cap`: variables, clauses and the guard "delay >= cap +
  /// 1" whose negation restricts it to them. No effect if it may already. False if `limits` ended
  /// that early, or paths would be longer than kMaxTimestep; of no further use then.
  [[nodiscard]] bool extend(const Graph& graph, Timestep cap, Formula& formula,
                            LimitMonitor* limits);
  /// Largest delay; -1 before the first `extend`.
  [[nodiscard]] Timestep cap() const { return static_cast<Timestep>(layers_.size()) - 1; }
  [[nodiscard]] const Mdd& mdd() const noexcept { return mdd_; }

  /// X(v,t), invalid if there is no such variable. O(1).
  [[nodiscard]] sat::Lit at(VertexId v, Timestep t) const;

 private:
  void make_layer(const Graph& graph, Timestep slack, Formula& formula);
  void add_delay_clauses(Timestep slack, Formula& formula);
  void add_predecessor_clauses(const Graph& graph, Timestep slack, Formula& formula);
  void add_successor_clauses(const Graph& graph, Timestep slack, Timestep old_cap,
                             Formula& formula);
  void add_end_clauses(Timestep slack, Formula& formula);

  Mdd mdd_;
  std::vector<std::vector<sat::Lit>> layers_;  // [slack][rank]
  std::vector<sat::Lit> scratch_;
};

}  // namespace quadrille::discrete
