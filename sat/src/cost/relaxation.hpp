// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "cost/core_counter.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/proof_log.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::sat {

/// The softs of OLL, numbers that each cost one per unit beyond a bound: at first what each agent
/// costs beyond its free cost, and fees. Every plan costs `bound()` plus what it violates.
class Relaxation {
 public:
  /// All must outlive the relaxation. Adds nothing yet.
  Relaxation(Engine& engine, CostProblem& problem, LimitMonitor& limits)
      : engine_(engine), problem_(problem), limits_(limits) {}

  /// To be called first. False: a limit came before all softs were made.
  [[nodiscard]] bool start();
  /// A lower bound of all plans: the agents' free costs and what was paid for the cores.
  [[nodiscard]] Cost bound() const noexcept { return bound_; }
  /// That no soft is violated: with it a plan costs `bound()`.
  [[nodiscard]] std::vector<Lit> assumptions() const;
  /// That each soft of a core, some of `assumptions()`, is violated by less than `lift` units: what
  /// has to be refuted before the core is relaxed by `lift`. No literal for a soft that no plan
  /// violates by `lift` units. Nothing if a limit came before that was done.
  [[nodiscard]] std::optional<std::vector<Lit>> raised(std::span<const Lit> core, Cost lift);
  /// Pays for a core whose softs cannot all be violated by less than `lift` >= 1 units: the bound
  /// rises by that. Watches for what the others of its softs come to up to there, and for what each
  /// comes to beyond. False: a limit came before that was done.
  [[nodiscard]] bool relax(std::span<const Lit> core, Cost lift = 1);

  /// From now on, remembers what raised the bound.
  void keep_raises() { keeps_raises_ = true; }
  /// What was remembered, without bystanders: for each core its agents, which are those that its
  /// softs count.
  [[nodiscard]] std::vector<Raise>& raises() noexcept { return raises_; }

  [[nodiscard]] std::size_t num_softs() const noexcept { return softs_.size(); }
  /// What plans cost beyond the bound: the sum of these inputs, one per soft as it is now. Valid
  /// until the relaxation is retired. For problems that need no growth.
  [[nodiscard]] Totalizer::Input excess() const;

  /// Tells the proof log that the sum of that number is over `excess()`.
  void note_excess(int sum) const;
  /// Tells it that no plan costs less than `bound()`.
  void note_bound() const;

  /// Ends the use of all counters, for good. Only destruction may follow.
  void retire();

 private:
  /// Violated by as many units as a number exceeds `bound`: what an agent costs, one that a counter
  /// keeps, or a fee.
  struct Soft {
    CoreCounter* counter;  // null: of an agent, or a fee
    int rank;              // of the counter's numbers; 0: all but the largest, as one number
    AgentId agent;
    Cost bound;
    const CostProblem::Fee* fee = nullptr;
  };
  [[nodiscard]] bool grow(const Soft& soft, Cost units);
  /// That the soft is violated by `units` >= 1 or more. Invalid if it never is.
  [[nodiscard]] Lit violated_by(const Soft& soft, Cost units) const;
  /// Adds the soft if it can be violated. False: a limit was met.
  [[nodiscard]] bool add(const Soft& soft);
  [[nodiscard]] static ProofItem proof_item(const Soft& soft);
  void note_core(const std::vector<Soft>& softs, Cost lift, int counter) const;
  [[nodiscard]] const Soft& soft_of(Lit assumption) const;
  [[nodiscard]] std::vector<AgentId> agents_of(const std::vector<Soft>& softs) const;

  Engine& engine_;
  CostProblem& problem_;
  LimitMonitor& limits_;
  std::map<Lit, Soft> softs_;
  std::list<CoreCounter> counters_;
  Cost bound_ = 0;
  int proof_pass_ = 0;
  bool keeps_raises_ = false;
  std::vector<Raise> raises_;
  std::map<const CoreCounter*, std::vector<AgentId>> counted_;  // with keeps_raises_
};

}  // namespace quadrille::sat
