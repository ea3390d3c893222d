// SPDX-License-Identifier: MIT
#include "quadrille/sat/core_guided_search.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "cost/descent.hpp"
#include "cost/relaxation.hpp"
#include "engine/offline_solver.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/core/random.hpp"

namespace quadrille::sat {
namespace {

/// A try to drop an assumption from a core ends after so much work; longer tries seldom succeed.
constexpr SolveBudget kTryBudget{60, 1000};
/// The same for tries in a random order: there are many of them.
constexpr SolveBudget kShortTryBudget{20, 200};
/// Conflicts spent on minimising may exceed those of the search by so many.
constexpr std::int64_t kFreeConflicts = 200;
/// Turns of the searches from below and from above grow, up to so many conflicts.
constexpr std::int64_t kLongestTurn = 1 << 28;
/// So many passes in a row that are no better than the best one are the last. Measured: where
/// passes gain anything, one that does not is soon followed by one that does.
constexpr int kVainPasses = 2;
/// After so many more cores the search from above starts again from what they have left open.
constexpr Cost kStaleCores = 8;

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
    // First, because a limit may end the search while the softs are made.
    for (const AgentId i : IdRange<AgentId>(problem_.num_agents()))
      report_.lower_bound += problem_.free_cost(i);
    search(statistics, on_bound);
    if (offline_) offline_->add_statistics(statistics);
    return report_;
  }

 private:
  void search(Statistics& statistics, const BoundListener& on_bound) {
    if (!start_pass()) return;
    while (true) {
      report_.lower_bound = std::max(report_.lower_bound, softs_->bound());
      if (on_bound) on_bound(report_.lower_bound);
      if (limits_.exhausted_now() || best_is_optimal()) return;
      const Verdict verdict = solve_main();
      if (verdict == Verdict::unknown) {
        if (limits_.exhausted_now()) return;
        if (pass_ < options_.passes) {
          if (!end_pass()) return;
        } else if (options_.plans != nullptr) {
          descend();
        } else {
          return;
        }
        continue;
      }
      if (verdict == Verdict::sat) {
        report_.end = SearchReport::End::found;
        return;
      }
      std::vector<Lit> core = engine_.core();
      if (options_.minimise_cores && !core.empty()) core = smallest_core(core);
      if (core.empty()) {
        report_.end = SearchReport::End::exhausted;
        return;
      }
      ++statistics.cores;
      if (!softs_->relax(core)) return;
    }
  }

  Verdict solve_main() {
    const std::vector<Lit> assumptions = softs_->assumptions();
    const std::int64_t before = limits_.conflicts();
    SolveBudget budget;
    if (pass_ < options_.passes)
      budget.conflicts = static_cast<int>(pass_ == 0 ? options_.first_turn : later_pass_turn());
    else if (options_.plans != nullptr)
      budget.conflicts = turn_from_below();
    problem_.on_solve(true);
    Verdict verdict = engine_.solve(assumptions, limits_, budget);
    while (verdict == Verdict::sat && !problem_.accept_model())
      verdict = engine_.solve(assumptions, limits_, budget);
    main_conflicts_ += limits_.conflicts() - before;
    return verdict;
  }

  [[nodiscard]] int turn_from_below() const {
    const std::int64_t turn = offline_ ? turn_ : options_.head_start * turn_;
    return static_cast<int>(std::min<std::int64_t>(turn, std::numeric_limits<int>::max()));
  }

  /// Short: what was learned makes all cores but the last ones easy.
  [[nodiscard]] std::int64_t later_pass_turn() const {
    return std::max<std::int64_t>(1, options_.first_turn / 4);
  }

  [[nodiscard]] bool best_is_optimal() const {
    return options_.plans != nullptr && options_.plans->best_cost() == report_.lower_bound;
  }

  [[nodiscard]] bool start_pass() {
    softs_ = std::make_unique<Relaxation>(engine_, problem_, limits_);
    pass_begin_ = main_conflicts_;
    return softs_->start();
  }

  /// Goes back to the start with what was learned, or, after the last pass, to the best of all.
  [[nodiscard]] bool end_pass() {
    const std::int64_t conflicts = main_conflicts_ - pass_begin_;
    const bool is_best = !best_softs_ || softs_->bound() > best_softs_->bound() ||
                         (softs_->bound() == best_softs_->bound() && conflicts < best_conflicts_);
    if (is_best) {
      best_softs_.swap(softs_);
      best_conflicts_ = conflicts;
    }
    vain_passes_ = is_best ? 0 : vain_passes_ + 1;
    if (softs_) softs_->retire();
    ++pass_;
    if (vain_passes_ == kVainPasses) pass_ = options_.passes;
    if (pass_ < options_.passes) return start_pass();
    softs_ = std::move(best_softs_);
    return true;
  }

  /// Gives the search from above its turn.
  void descend() {
    if (descent_ && softs_->bound() >= descent_->base() + kStaleCores) {
      descent_->retire();
      descent_.reset();
    }
    if (!offline_) offline_.emplace(engine_);
    if (!descent_)
      descent_.emplace(engine_, *offline_, problem_, *options_.plans, limits_, softs_->bound(),
                       softs_->num_softs(), softs_->excess(), options_.candidates_within);
    report_.lower_bound =
        std::max(report_.lower_bound,
                 descent_->advance(report_.lower_bound, options_.descent_share * turn_));
    turn_ = std::max(turn_, std::min(2 * turn_, kLongestTurn));
  }

  /// The smallest of some minimal parts of a core. Measured: it is worth while to look for more
  /// than one only during the passes, and not everywhere (`core_tries`). Conflicts of these tries
  /// do not count for later cores.
  std::vector<Lit> smallest_core(const std::vector<Lit>& core) {
    const bool is_short = options_.core_tries > 0;
    std::vector<Lit> best = minimise(core, is_short);
    if (pass_ == options_.passes) return best;
    const std::int64_t before = minimising_conflicts_;
    for (int k = 0; k < options_.core_tries && best.size() > 2 && !limits_.exhausted(); ++k) {
      std::vector<Lit> shuffled = core;
      random_.shuffle_front(shuffled, shuffled.size());
      std::vector<Lit> other = minimise(std::move(shuffled), is_short);
      if (other.size() < best.size()) best = std::move(other);
    }
    minimising_conflicts_ = before;
    return best;
  }

  /// Tries to refute a part of a core's assumptions: `unsat` with a smaller core at best.
  Verdict solve_part(const std::vector<Lit>& assumptions, bool is_short) {
    problem_.on_solve(false);
    const std::int64_t before = limits_.conflicts();
    const Verdict verdict =
        engine_.solve(assumptions, limits_, is_short ? kShortTryBudget : kTryBudget);
    minimising_conflicts_ += limits_.conflicts() - before;
    return verdict;
  }

  /// Deletion-based, each try and all of them under a budget counted in conflicts, so that it is
  /// deterministic. What is learned on the way is kept in any case.
  std::vector<Lit> minimise(std::vector<Lit> core, bool is_short) {
    for (std::size_t at = 0; at < core.size() && core.size() > 1;) {
      if (minimising_conflicts_ > main_conflicts_ + kFreeConflicts || limits_.exhausted()) break;
      std::vector<Lit> part = core;
      part.erase(part.begin() + static_cast<std::ptrdiff_t>(at));
      if (solve_part(part, is_short) != Verdict::unsat) {
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

  Engine& engine_;
  AgentCostProblem& problem_;
  const CoreGuidedOptions options_;
  LimitMonitor& limits_;
  SearchReport report_;
  int pass_ = 0, vain_passes_ = 0;
  std::unique_ptr<Relaxation> softs_, best_softs_;
  std::int64_t pass_begin_ = 0, best_conflicts_ = 0;
  std::optional<OfflineSolver> offline_;  // since the first turn from above
  std::optional<Descent> descent_;
  Random random_{1};
  std::int64_t turn_;  // conflicts
  std::int64_t main_conflicts_ = 0, minimising_conflicts_ = 0;
};

}  // namespace

SearchReport search_by_cores(Engine& engine, AgentCostProblem& problem,
                             const CoreGuidedOptions& options, LimitMonitor& limits,
                             Statistics& statistics, const BoundListener& on_bound) {
  return CoreGuidedSearch(engine, problem, options, limits).run(statistics, on_bound);
}

}  // namespace quadrille::sat
