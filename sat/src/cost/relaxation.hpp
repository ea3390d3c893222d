// SPDX-License-Identifier: MIT
#pragma once

#include <list>
#include <map>
#include <span>
#include <vector>

#include "quadrille/sat/cost_search.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::sat {

/// The softs of OLL, literals that each cost one unit when true, and what comes after them: at
/// first "the agent costs more than nothing hinders it to", for each agent. Every plan costs
/// `bound()` plus what it violates.
class Relaxation {
 public:
  /// All must outlive the relaxation. Adds nothing yet.
  Relaxation(Engine& engine, CostProblem& problem, LimitMonitor& limits)
      : engine_(engine), problem_(problem), limits_(limits) {}

  /// To be called first. False: a limit came before all softs were made.
  [[nodiscard]] bool start();
  /// A lower bound of all plans: the agents' free costs and one for each core.
  [[nodiscard]] Cost bound() const noexcept { return bound_; }
  /// That no soft is violated: with it a plan costs `bound()`.
  [[nodiscard]] std::vector<Lit> assumptions() const;
  /// Pays for a core, some assumptions that no plan meets together: watches for a second violation
  /// among its softs, and for the next unit of each. False: a limit came before that was done.
  [[nodiscard]] bool relax(std::span<const Lit> core);

  [[nodiscard]] std::size_t num_softs() const noexcept { return softs_.size(); }
  /// What plans cost beyond the bound: the sum of these inputs, one per soft as it is now. Valid
  /// until the relaxation is retired. For problems that need no growth.
  [[nodiscard]] Totalizer::Input excess() const;

  /// Ends the use of all counters, for good. Only destruction may follow.
  void retire();

 private:
  /// Violated when the agent costs more than `bound`, or more than `bound` inputs of a counter are
  /// true.
  struct Soft {
    Totalizer* counter;  // null: of an agent
    AgentId agent;
    Cost bound;
  };
  [[nodiscard]] bool add_agent_soft(AgentId agent, Cost bound);
  void add_counter_soft(Totalizer& counter, Cost bound);

  Engine& engine_;
  CostProblem& problem_;
  LimitMonitor& limits_;
  std::map<Lit, Soft> softs_;
  std::list<Totalizer> counters_;
  Cost bound_ = 0;
};

}  // namespace quadrille::sat
