// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solve/cost_problem.hpp"

namespace quadrille::continuous {

/// Makes cores stronger by short searches: smaller, and with higher levels.
class CoreShrinker {
 public:
  /// Both arguments outlive the shrinker.
  CoreShrinker(CostProblem& problem, LimitMonitor& limits)
      : problem_(problem), limits_(limits), settings_(problem.model().scene().settings()) {}

  /// `core` is that of the problem's last question. The result holds for plans in which nobody
  /// costs more than its ceiling, and hits no costs that `core` does not hit. Empty: there is no
  /// such plan. When the limits are met, what has been reached.
  [[nodiscard]] LevelCore shrink(LevelCore core, const IdVector<AgentId, Cost>& ceilings);
  /// Whether that is a core, as far as a short search can tell; then the problem has the core.
  /// Requires levels above the free costs.
  [[nodiscard]] bool is_core(const LevelCore& candidate, const IdVector<AgentId, Cost>& ceilings);
  /// Whose ceilings the last result rests on, if the problem keeps them. Increasing.
  [[nodiscard]] const std::vector<AgentId>& ceilings_of_core() const noexcept {
    return ceilings_of_core_;
  }

 private:
  /// The known thresholds to which a level may be raised, and which of them have been tried.
  struct Ladder {
    Cost lowest = 0;           // where the level began
    std::vector<Cost> higher;  // increasing
    // Of `higher`, counted from 1: with the first `good` it is a core, with number `bad` it is not.
    std::size_t good = 0, bad = 1, step = 1;
    [[nodiscard]] bool is_done() const { return good + 1 >= bad; }
    /// Where the first `number` thresholds lead to.
    [[nodiscard]] Cost cost(std::size_t number) const {
      return number == 0 ? lowest : higher[number - 1];
    }
    [[nodiscard]] Cost risen() const { return cost(good) - lowest; }
  };
  /// A core with the ladders of its levels.
  struct Climb {
    LevelCore core;
    std::vector<Ladder> ladders;
    /// How many thresholds each level has been raised by.
    [[nodiscard]] std::vector<std::size_t> goods() const;
  };

  [[nodiscard]] sat::SolveBudget raise_budget() const;
  [[nodiscard]] sat::SolveBudget drop_budget() const;
  [[nodiscard]] bool is_core(const LevelCore& core, const IdVector<AgentId, Cost>& ceilings,
                             const sat::SolveBudget& budget);
  void raise(LevelCore& core, const IdVector<AgentId, Cost>& ceilings);
  void raise_together(Climb& climb, const IdVector<AgentId, Cost>& ceilings);
  void raise_singly(Climb& climb, const IdVector<AgentId, Cost>& ceilings);
  /// Whether that is still a core with each level raised by its number of thresholds in `goods`,
  /// none below `good`. Then it has these, and is without the levels that are not needed.
  bool has_raised(Climb& climb, const std::vector<std::size_t>& goods,
                  const IdVector<AgentId, Cost>& ceilings);
  [[nodiscard]] Ladder ladder(const Level& level, Cost ceiling) const;
  [[nodiscard]] bool drops_pay() const;
  void drop(LevelCore& core, const IdVector<AgentId, Cost>& ceilings);

  CostProblem& problem_;
  LimitMonitor& limits_;
  const Settings& settings_;
  std::vector<AgentId> ceilings_of_core_;
  std::int64_t num_shrunk_ = 0, num_dropped_ = 0, num_kept_ = 0;  // cores; levels
};

}  // namespace quadrille::continuous
