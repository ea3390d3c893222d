// SPDX-License-Identifier: MIT
#include "solve/cover_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "primal/plan_improver.hpp"
#include "quadrille/core/random.hpp"
#include "solve/core_shrinker.hpp"

namespace quadrille::continuous {
namespace {

using End = sat::SearchEnd;
using sat::Verdict;
using Core = LevelCore;

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

sat::SolveBudget conflicts(std::int64_t count) { return {static_cast<int>(count), {}}; }

Cost sum(const IdVector<AgentId, Cost>& costs) {
  return std::accumulate(costs.begin(), costs.end(), Cost{0});
}

class CoverSearch {
 public:
  explicit CoverSearch(const SumSearchContext& context)
      : context_(context),
        problem_(context.problem),
        limits_(context.limits),
        settings_(problem_.model().scene().settings()),
        cover_(free_costs()),
        shrinker_(problem_, limits_),
        random_(context.seed) {
    report_.lower_bound = context.known.lower_bound;
    report_.plan = context.known.plan;
    if (context.trace != nullptr) problem_.keep_ceilings_of_core();
  }

  /// What the bound of the last cover follows from.
  [[nodiscard]] std::vector<Raise> raises() const {
    std::vector<Raise> raises;
    for (CoverShare& share : cover_.shares())
      raises.push_back({share.is_of_one_core ? RaiseKind::core : RaiseKind::cover,
                        share.amount,
                        std::move(share.agents),
                        {}});
    return raises;
  }

  [[nodiscard]] std::vector<ProvedCover> covers() const { return cover_.proved(); }

  CostReport run() {
    raise_bound(cover_.total());
    if (is_closed()) return report_;
    const Role role = context_.role;
    if (!context_.candidates.empty()) {
      if (try_candidates()) return report_;
    } else if ((role == Role::all || role == Role::plans) && improve_at_first()) {
      return report_;
    }
    if ((role == Role::plans || role == Role::cores) && guess_costs()) return report_;
    while (true) {
      raise_bound(cover_.total());
      if (is_closed() || limits_.exhausted_now()) return report_;
      // What others have found asks for other costs.
      if (std::exchange(has_new_cores_, false)) {
        if (!solve_cover()) return report_;
        continue;
      }
      const Verdict verdict = ask();
      if (verdict == Verdict::unknown) return report_;
      if (verdict == Verdict::sat) {
        report_.plan = problem_.plan();
        if (cover_.is_exact()) {
          report_.end = End::found;
          return report_;
        }
        if (!solve_cover()) return report_;  // goes on with it
        continue;
      }
      if (!learn_disjoint_cores(above(asked_)) && end_without_plans()) return report_;
      if (!solve_cover()) return report_;
      if (context_.statistics.cores >= next_improvement_) {
        next_improvement_ = kNever;
        if (improve_at_first()) return report_;
      }
      if (context_.statistics.cores >= next_turn_ && look_for_plan()) return report_;
    }
  }

 private:
  /// The levels that are just above caps.
  [[nodiscard]] std::vector<Level> above(const IdVector<AgentId, Cost>& caps) const {
    std::vector<Level> levels;
    for (const AgentId i : problem_.payers())
      if (const auto level = problem_.level_above(i, caps[i])) levels.push_back(*level);
    return levels;
  }
  /// Requires one.
  [[nodiscard]] Cost cost_of_plan() const { return problem_.cost_of(*report_.plan); }

  /// Tells what is known, and hears what others know.
  bool is_closed() {
    const Message heard = context_.correspondent.report(report_);
    if (heard.plan && (!report_.plan || heard.cost < cost_of_plan())) report_.plan = *heard.plan;
    raise_bound(heard.lower);
    for (const ToldCores::Of& told : heard.extra.all)
      for (const auto& core : told.list) {
        problem_.take_core(*core);
        cover_.add(*core);
        has_new_cores_ = true;
      }
    if (!report_.plan || cost_of_plan() > report_.lower_bound) return false;
    report_.end = End::found;
    return true;
  }

  /// A search for plans or for covers takes time that no engine has counted.
  void count(Effort effort, Effort& seen) {
    context_.correspondent.add_effort(effort - seen);
    seen = effort;
  }

  bool solve_cover() {
    const bool is_solved = cover_.solve(limits_);
    count(cover_.effort(), seen_cover_effort_);
    return is_solved;
  }

  /// The first cores are strong only if the plan is good: with the ceilings that follow from a dear
  /// plan little can be refuted, and every attempt takes long. Measured as against a turn after 30
  /// cores, gap after 15 s: empty16 (k = 3, 50 agents) 1.07 and 0.67 %, dense (32) 0.23 and 0.09 %.
  /// True if that ended the search.
  bool improve_at_first() {
    do {
      if (is_closed()) return true;
      const Effort least = Effort::microseconds(settings_.cover_first_plan_effort);
      improve(std::clamp(improver_ ? improver_->effort() / 4 : Effort(), least, 8 * least));
    } while (improver_ && improver_->pays() && !limits_.exhausted_now());
    return false;
  }

  void improve(Effort effort) {
    if (!report_.plan) return;
    if (!improver_)
      improver_.emplace(problem_.model().scene(), *report_.plan);
    else if (cost_of_plan() < problem_.cost_of(improver_->plan()))
      improver_->restart_from(*report_.plan);
    // It knows no fees.
    if (improver_->improve(effort) && problem_.cost_of(improver_->plan()) < cost_of_plan())
      report_.plan = improver_->plan();
    count(improver_->effort(), seen_plan_effort_);
  }

  /// Finds cores of costs that need not be the cheapest: drawn ones, beside a search that covers
  /// the cores of both. So the two find different cores, and no cover is waited for. Until drawn
  /// costs are no cheaper than the plan. True if that ended the search.
  bool guess_costs() {
    IdVector<AgentId, Cost> last = cover_.costs();
    const auto kept_percent = static_cast<std::size_t>(settings_.cover_kept_percent);
    for (std::int64_t misses = 0; misses <= settings_.cover_guess_misses;) {
      if (is_closed() || limits_.exhausted_now()) return true;
      IdVector<AgentId, Cost> drawn = free_costs();
      for (const AgentId i : problem_.payers())
        if (random_.below(100) < kept_percent) drawn[i] = last[i];
      drawn = cover_.completed(std::move(drawn));
      if (report_.plan && sum(drawn) >= cost_of_plan()) {
        ++misses;
        continue;
      }
      const Verdict verdict = problem_.solve(
          {.below = above(drawn), .budget = conflicts(settings_.cover_guess_conflicts)}, limits_);
      if (verdict == Verdict::sat) report_.plan = problem_.plan();
      if (verdict == Verdict::unknown) ++misses;
      if (verdict != Verdict::unsat) continue;
      misses = 0;
      if (!learn_disjoint_cores(above(drawn))) return end_without_plans();
      last = std::move(drawn);
    }
    has_new_cores_ = true;
    return false;
  }

  /// Whether there is a plan at the costs of the cheapest cover. First whether somewhat higher ones
  /// can be refuted at once, as they nearly always can: cores of those are stronger. Only pairs of
  /// which that refuted something are searched then: others would delay what is needed.
  Verdict ask() {
    asked_ = towards_plan();
    const sat::SolveBudget budget{static_cast<int>(settings_.cover_inner_conflicts),
                                  {},
                                  Effort::microseconds(settings_.cover_inner_effort)};
    const Question inner{
        .below = above(asked_), .budget = budget, .search = Question::Search::quick};
    if (settings_.cover_inner_conflicts > 0 && asked_ != cover_.costs() &&
        problem_.solve(inner, limits_) == Verdict::unsat)
      return Verdict::unsat;
    asked_ = cover_.costs();
    return problem_.solve({.below = above(asked_)}, limits_);
  }

  /// The costs of the cheapest cover, and a part of the way to the plan where that is dearer:
  /// in-out separation (Ben-Ameur and Neto 2007), as cutting planes converge faster with it.
  [[nodiscard]] IdVector<AgentId, Cost> towards_plan() const {
    IdVector<AgentId, Cost> costs = cover_.costs();
    if (report_.plan)
      for (const AgentId i : problem_.payers())
        costs[i] += std::max<Cost>(problem_.cost_in(*report_.plan, i) - costs[i], 0) /
                    settings_.cover_inner_part;
    return costs;
  }

  /// There are no plans but the known one, if there is one.
  bool end_without_plans() {
    report_.end = report_.plan ? End::found : End::exhausted;
    if (report_.plan) raise_bound(kAnyCost);
    return true;
  }

  /// From time to time a better plan, or any one: without a plan there are no ceilings. True if
  /// that ended the search.
  bool look_for_plan() {
    const std::int64_t cores = context_.statistics.cores;
    next_turn_ = cores + std::max<std::int64_t>(cores / 4, 1);
    improve(Effort::microseconds(settings_.cover_plan_effort));
    if (report_.plan) return is_closed();
    const Verdict verdict =
        problem_.solve({.budget = conflicts(settings_.cover_next_conflicts)}, limits_);
    if (verdict == Verdict::unsat) return end_without_plans();
    if (verdict == Verdict::sat) report_.plan = problem_.plan();
    return is_closed();
  }

  [[nodiscard]] IdVector<AgentId, Cost> free_costs() const {
    IdVector<AgentId, Cost> costs;
    for (const AgentId i : problem_.payers()) costs.push_back(problem_.free_cost(i));
    return costs;
  }

  /// Cores say nothing about plans that are no cheaper than the known one.
  void raise_bound(Cost bound) {
    if (report_.plan) bound = std::min(bound, cost_of_plan());
    report_.lower_bound = std::max(report_.lower_bound, bound);
  }

  /// What each agent costs at most in plans that are cheaper than the known one. With those, cores
  /// are smaller: the others may not go any way round that they like.
  [[nodiscard]] IdVector<AgentId, Cost> ceilings() const {
    IdVector<AgentId, Cost> ceilings = free_costs();
    Cost rest = kAnyCost;
    if (report_.plan) rest = std::max(cost_of_plan() - 1, context_.spared) - sum(ceilings);
    for (Cost& ceiling : ceilings) ceiling = std::min(ceiling + rest, kAnyCost);
    return ceilings;
  }

  /// After a refutation of `below`: cores without common agents, as long as the known clauses give
  /// some. False: one is empty.
  bool learn_disjoint_cores(Core below) {
    while (true) {
      const IdVector<AgentId, Cost> highest = ceilings();
      const Core core = shrinker_.shrink(problem_.core(), highest);
      if (!learn(core, highest)) return false;
      std::erase_if(below, [&](const Level& level) {
        return std::any_of(core.begin(), core.end(),
                           [&](const auto& used) { return used.agent == level.agent; });
      });
      if (below.empty() || limits_.exhausted_now() || !is_refuted(below)) return true;
    }
  }

  /// What was refuted with the ceilings. False: it is empty.
  bool learn(const Core& core, const IdVector<AgentId, Cost>& ceilings) {
    problem_.add_core(core, ceilings, shrinker_.ceilings_of_core());
    if (core.empty()) return false;
    ++context_.statistics.cores;
    if (context_.trace != nullptr) trace(core);
    cover_.add(core);
    context_.correspondent.report_core(core);
    return true;
  }

  /// A question for each candidate. True if that ended the search.
  bool try_candidates() {
    improve(Effort::microseconds(settings_.cover_mend_effort));
    for (const Core& candidate : context_.candidates) {
      if (is_closed() || limits_.exhausted()) return true;
      const bool is_hit = std::any_of(candidate.begin(), candidate.end(), [&](const Level& level) {
        return level.cost <= problem_.free_cost(level.agent);
      });
      const IdVector<AgentId, Cost> highest = ceilings();
      if (is_hit || !shrinker_.is_core(candidate, highest)) continue;
      if (!learn(problem_.core(), highest)) return end_without_plans();
    }
    if (context_.role == Role::all)
      next_improvement_ = context_.statistics.cores + settings_.cover_mend_cores;
    return !solve_cover();
  }

  void trace(const Core& core) {
    std::vector<AgentId> agents;
    for (const Level& level : core) agents.push_back(level.agent);
    context_.trace->cores.push_back({std::move(agents), shrinker_.ceilings_of_core()});
  }

  /// Whether known clauses say that one of these levels is reached.
  bool is_refuted(const Core& below) {
    return problem_.solve({.below = below,
                           .budget = conflicts(settings_.cover_next_conflicts),
                           .search = Question::Search::known_clauses},
                          limits_) == Verdict::unsat;
  }

  const SumSearchContext context_;
  CostProblem& problem_;
  LimitMonitor& limits_;
  const Settings& settings_;
  LevelCover cover_;
  CoreShrinker shrinker_;
  Random random_;
  std::optional<PlanImprover> improver_;
  CostReport report_;
  bool has_new_cores_ = false;  // that came from others
  std::int64_t next_improvement_ = kNever;
  std::int64_t next_turn_ = 30;
  IdVector<AgentId, Cost> asked_;                // costs of the last question
  Effort seen_plan_effort_, seen_cover_effort_;  // that were told
};

}  // namespace

CostReport search_by_covers(const SumSearchContext& context) {
  CoverSearch search(context);
  const auto trace = [&] {
    if (context.trace != nullptr) context.trace->raises = search.raises();
    if (context.covers != nullptr) *context.covers = search.covers();
  };
  try {
    CostReport report = search.run();
    trace();
    return report;
  } catch (const LimitReached&) {
    trace();
    throw;
  }
}

}  // namespace quadrille::continuous
