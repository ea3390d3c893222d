// SPDX-License-Identifier: MIT
#include "quadrille/sat/core_guided_search.hpp"

#include <algorithm>
#include <list>
#include <map>
#include <optional>
#include <vector>

#include "descent.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/sat/totalizer.hpp"

namespace quadrille::sat {
namespace {

/// A try to drop an assumption from a core ends after so much work; longer tries seldom succeed.
constexpr SolveBudget kTryBudget{60, 1000};
/// Conflicts spent on minimising may exceed those of the search by so many.
constexpr std::int64_t kFreeConflicts = 200;
/// Turns of the searches from below and from above grow, up to so many conflicts.
constexpr std::int64_t kLongestTurn = 1 << 28;
/// After so many more cores the search from above starts again from what they have left open.
constexpr Cost kStaleCores = 8;

/// The softs of OLL: literals that each cost one unit when true, and what comes after them.
class CoreGuidedSearch {
 public:
  CoreGuidedSearch(Engine& engine, AgentCostProblem& problem, const CoreGuidedOptions& options,
                   LimitMonitor& limits)
      : engine_(engine),
        problem_(problem),
        options_(options),
        limits_(limits),
        turn_(options.first_turn) {}

  SearchReport run(Statistics& statistics, const BoundListener& on_bound) {
    const IdRange<AgentId> agents(problem_.num_agents());
    // First, because a limit may end the search while the softs are made.
    for (const AgentId i : agents) report_.lower_bound += problem_.free_cost(i);
    for (const AgentId i : agents)
      if (!add_agent_soft(i, problem_.free_cost(i))) return report_;
    cores_bound_ = report_.lower_bound;
    while (true) {
      report_.lower_bound = std::max(report_.lower_bound, cores_bound_);
      if (on_bound) on_bound(report_.lower_bound);
      if (limits_.exhausted_now() || best_is_optimal()) return report_;
      const Verdict verdict = solve_main();
      if (verdict == Verdict::unknown) {
        if (options_.plans == nullptr || limits_.exhausted_now()) return report_;
        descend();
        continue;
      }
      if (verdict == Verdict::sat) {
        report_.end = SearchReport::End::found;
        return report_;
      }
      std::vector<Lit> core = engine_.core();
      if (core.empty()) {
        report_.end = SearchReport::End::exhausted;
        return report_;
      }
      if (options_.minimise_cores) core = minimise(std::move(core));
      if (core.empty()) {
        report_.end = SearchReport::End::exhausted;
        return report_;
      }
      ++statistics.cores;
      ++cores_bound_;
      if (!relax(core)) return report_;
    }
  }

 private:
  /// Violated when the agent costs more than `bound`, or more than `bound` inputs of a counter are
  /// true.
  struct Soft {
    Totalizer* counter;  // null: of an agent
    AgentId agent;
    Cost bound;
  };

  bool add_agent_soft(AgentId agent, Cost bound) {
    const auto lit = problem_.cost_above(agent, bound, limits_);
    if (!lit) return false;
    softs_.emplace(*lit, Soft{nullptr, agent, bound});
    return true;
  }

  void add_counter_soft(Totalizer& counter, Cost bound) {
    softs_.emplace(counter.at_least(static_cast<int>(bound) + 1), Soft{&counter, AgentId(), bound});
  }

  Verdict solve_main() {
    std::vector<Lit> assumptions;
    for (const auto& [lit, soft] : softs_) assumptions.push_back(~lit);
    const std::int64_t before = limits_.conflicts();
    SolveBudget budget;
    if (options_.plans != nullptr) budget.conflicts = static_cast<int>(turn_);
    problem_.on_solve(true);
    Verdict verdict = engine_.solve(assumptions, limits_, budget);
    while (verdict == Verdict::sat && !problem_.accept_model())
      verdict = engine_.solve(assumptions, limits_, budget);
    main_conflicts_ += limits_.conflicts() - before;
    return verdict;
  }

  [[nodiscard]] bool best_is_optimal() const {
    return options_.plans != nullptr && options_.plans->best_cost() == report_.lower_bound;
  }

  /// Gives the search from above its turn.
  void descend() {
    if (!descent_ || cores_bound_ >= descent_->base() + kStaleCores) {
      std::vector<Soft> items;
      for (const auto& [lit, soft] : softs_) items.push_back(soft);
      const auto excess = [this, items](std::size_t input, int k) {
        const Soft& soft = items[input];
        const Cost beyond = soft.bound + k;
        if (soft.counter == nullptr) {
          const auto lit = problem_.cost_above(soft.agent, beyond - 1, limits_);
          QUADRILLE_REQUIRE(lit.has_value(), "see CoreGuidedOptions::plans");
          return *lit;
        }
        if (beyond > static_cast<Cost>(soft.counter->num_inputs())) return Lit();
        return soft.counter->at_least(static_cast<int>(beyond));
      };
      descent_.emplace(engine_, problem_, *options_.plans, limits_, cores_bound_, items.size(),
                       excess);
    }
    report_.lower_bound =
        std::max(report_.lower_bound,
                 descent_->advance(report_.lower_bound, options_.descent_share * turn_));
    turn_ = std::max(turn_, std::min(2 * turn_, kLongestTurn));
  }

  /// Tries to refute a part of a core's assumptions: `unsat` with a smaller core at best.
  Verdict solve_part(const std::vector<Lit>& assumptions) {
    problem_.on_solve(false);
    const std::int64_t before = limits_.conflicts();
    const Verdict verdict = engine_.solve(assumptions, limits_, kTryBudget);
    minimising_conflicts_ += limits_.conflicts() - before;
    return verdict;
  }

  /// Deletion-based, each try and all of them under a budget counted in conflicts, so that it is
  /// deterministic. What is learned on the way is kept in any case.
  std::vector<Lit> minimise(std::vector<Lit> core) {
    for (std::size_t at = 0; at < core.size() && core.size() > 1;) {
      if (minimising_conflicts_ > main_conflicts_ + kFreeConflicts || limits_.exhausted()) break;
      std::vector<Lit> part = core;
      part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
      if (solve_part(part) != Verdict::unsat) {
        ++at;
        continue;
      }
      // Those before `at` are known to be needed by the last core; the new one may lack some.
      const std::vector<Lit> smaller = engine_.core();
      at = static_cast<std::size_t>(
          std::count_if(core.begin(), core.begin() + static_cast<std::ptrdiff_t>(at), [&](Lit lit) {
            return std::find(smaller.begin(), smaller.end(), lit) != smaller.end();
          }));
      core = smaller;
    }
    return core;
  }

  /// One of the core's softs is violated in every plan: pays for one, and watches for a second one
  /// and for the next unit of each.
  bool relax(const std::vector<Lit>& core) {
    std::vector<Lit> violated;
    for (const Lit assumption : core) violated.push_back(~assumption);
    engine_.add_clause({LemmaKind::core, violated, {}, false});
    for (const Lit lit : violated) {
      const auto found = softs_.find(lit);
      QUADRILLE_REQUIRE(found != softs_.end(), "cores consist of softs");
      const Soft soft = found->second;
      softs_.erase(found);
      if (soft.counter != nullptr) {
        if (soft.bound + 1 < static_cast<Cost>(soft.counter->num_inputs()))
          add_counter_soft(*soft.counter, soft.bound + 1);
      } else if (!add_agent_soft(soft.agent, soft.bound + 1)) {
        return false;
      }
    }
    if (violated.size() > 1) {
      // The inputs are literals: numbers of 0 or 1.
      counters_.emplace_back(engine_, violated.size(), [violated](std::size_t input, int k) {
        return k == 1 ? violated[input] : Lit();
      });
      add_counter_soft(counters_.back(), 1);
    }
    return true;
  }

  Engine& engine_;
  AgentCostProblem& problem_;
  const CoreGuidedOptions options_;
  LimitMonitor& limits_;
  SearchReport report_;
  std::map<Lit, Soft> softs_;
  std::list<Totalizer> counters_;
  std::optional<Descent> descent_;
  Cost cores_bound_ = 0;  // what the cores have been paid for
  std::int64_t turn_;     // conflicts
  std::int64_t main_conflicts_ = 0, minimising_conflicts_ = 0;
};

}  // namespace

SearchReport search_by_cores(Engine& engine, AgentCostProblem& problem,
                             const CoreGuidedOptions& options, LimitMonitor& limits,
                             Statistics& statistics, const BoundListener& on_bound) {
  return CoreGuidedSearch(engine, problem, options, limits).run(statistics, on_bound);
}

}  // namespace quadrille::sat
