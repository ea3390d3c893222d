// SPDX-License-Identifier: MIT
#include "solve/cost_run.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "quadrille/core/internal_error.hpp"
#include "quadrille/core/plan_claim.hpp"
#include "quadrille/core/progress.hpp"
#include "solve/auditors.hpp"
#include "solve/cost_problem.hpp"
#include "solve/cover_search.hpp"
#include "solve/lemma_keeper.hpp"
#include "solve/makespan_search.hpp"
#include "theory/lemma_recorder.hpp"
#include "theory/theory.hpp"

namespace quadrille::continuous {
namespace {

class CostRun final : private sat::YieldPoint, private Correspondent {
 public:
  CostRun(const SolveOptions& options, const CostReport& known, const Inheritance& inheritance,
          LimitMonitor& limits, Companion* companion)
      : options_(options),
        known_(known),
        inheritance_(inheritance),
        limits_(limits),
        companion_(companion),
        progress_(options.on_progress, options.progress_interval_s, limits) {
    outcome_.lower_bound = known.lower_bound;
    if (known.plan) keep(std::make_shared<const Plan>(*known.plan), cost_of(*known.plan));
    tell_known();
    progress_.enter(Phase::search);
  }

  SolveOutcome run(Scene& scene) {
    try {
      search(scene);
    } catch (const LimitReached&) {
      outcome_.plan = best();
      keep_best(options_, outcome_);
    } catch (const InternalError& error) {
      outcome_.internal_error = Error{ErrorCode::internal, error.message, {}};
      outcome_.plan = best();
      keep_best(options_, outcome_);
    } catch (const std::bad_alloc&) {
      // The search's memory is free again: the bound and the best plan are the answer.
      outcome_.stop = StopReason::memory;
      outcome_.plan = best();
      keep_best(options_, outcome_);
    }
    const bool is_cut = outcome_.status == Status::unknown || outcome_.status == Status::feasible;
    if (is_cut && outcome_.stop == StopReason::none) outcome_.stop = limits_.reason();
    if (outcome_.plan) outcome_.cost = cost_of(*outcome_.plan);
    return std::move(outcome_);
  }

 private:
  void search(Scene& scene) {
    Model model(scene);
    ContinuousTheory theory(model);
    Auditors auditors(model, options_.debug);
    const bool in_search = options_.system == System::dpll;
    sat::EngineOptions engine_options;
    engine_options.seed = options_.seed;
    engine_options.observer = auditors.is_needed() ? &auditors : nullptr;
    std::optional<LemmaRecorder> recorder;
    if (options_.explain) {
      recorder.emplace(model, engine_options.observer);
      engine_options.observer = &*recorder;
    }
    std::optional<LemmaKeeper> keeper;
    if (inheritance_.legacy != nullptr) {
      keeper.emplace(model, engine_options.observer);
      engine_options.observer = &*keeper;
    }
    sat::Engine engine(in_search ? &theory : nullptr, engine_options);
    engine_ = &engine;
    CostProblem problem(model, engine, theory, in_search, this, auditors.of_cores());
    const Cost spared = options_.debug.known_plan ? cost_of(*options_.debug.known_plan) : 0;
    const Role role = companion_ != nullptr ? companion_->role() : Role::all;
    CostTrace trace;
    CostTrace* const traced = recorder ? &trace : nullptr;
    const auto conclude = [&](bool has_plan) {
      if (keeper) bequeath(*keeper);
      if (recorder) explain(*recorder, std::move(trace), has_plan);
      engine.add_statistics(outcome_.statistics);
      outcome_.statistics.checks = theory.num_checks();
      engine_ = nullptr;
    };
    CostReport report;
    try {
      lazy::EngineWriter writer(engine);
      take_up(inheritance_.learned.lemmas, model, writer);
      report =
          options_.objective == Objective::sum_of_costs
              ? search_by_covers({problem, known_, spared, role, options_.seed, limits_,
                                  outcome_.statistics, *this, inheritance_.learned.cores, traced})
              : search_makespan(problem, known_, limits_, outcome_.statistics, *this, traced);
    } catch (const LimitReached&) {
      conclude(plan_ != nullptr);
      throw;
    }
    conclude(plan_ || report.plan);
    outcome_.lower_bound = std::max(outcome_.lower_bound, report.lower_bound);
    if (const auto complaint = auditors.complaint()) {
      outcome_.internal_error = Error{ErrorCode::internal, *complaint, {}};
    } else if (report.end == sat::SearchEnd::exhausted) {
      outcome_.status = Status::infeasible;
      outcome_.explanation = "every combination of paths collides";
    } else {
      // What was found last need not have been reported.
      const bool is_last = report.plan && (!plan_ || cost_of(*report.plan) < plan_cost_);
      outcome_.plan = is_last ? report.plan : best();
      keep_best(options_, outcome_);
      if (report.end == sat::SearchEnd::found && outcome_.status != Status::optimal &&
          !is_bound_refuted())
        outcome_.internal_error =
            Error{ErrorCode::internal, "the plan found does not cost the proven bound", {}};
    }
  }

  void explain(const LemmaRecorder& recorder, CostTrace trace, bool has_plan) {
    sat::Dependence dependence = recorder.dependence(has_plan);
    for (CoreUse& core : trace.cores) dependence.imply(core.agents, std::move(core.ceilings));
    for (Raise& raise : trace.raises) dependence.add_bystanders(raise);
    outcome_.attribution.emplace();
    outcome_.attribution->raises = std::move(trace.raises);
    outcome_.attribution->sites = recorder.sites();
  }

  void bequeath(const LemmaKeeper& keeper) {
    Learned learned{keeper.stock(), std::move(learned_cores_)};
    *inheritance_.legacy = std::move(learned);
  }

  [[nodiscard]] Cost cost_of(const Plan& plan) const { return cost(plan, options_.objective); }

  void keep(std::shared_ptr<const Plan> plan, Cost cost) {
    plan_ = std::move(plan);
    plan_cost_ = cost;
  }
  [[nodiscard]] std::optional<Plan> best() const {
    return plan_ ? std::optional<Plan>(*plan_) : std::nullopt;
  }

  // Correspondent
  News report(const CostReport& report) override {
    outcome_.lower_bound = std::max(outcome_.lower_bound, report.lower_bound);
    if (report.plan) {
      const Cost cost = cost_of(*report.plan);
      if (!plan_ || cost < plan_cost_) keep(std::make_shared<const Plan>(*report.plan), cost);
    }
    yield();
    return std::exchange(heard_, {});
  }
  void report_core(const LevelCore& core) override {
    if (inheritance_.legacy != nullptr) learned_cores_.push_back(core);
    if (companion_ != nullptr && !options_.debug.audit)
      cores_.push_back(std::make_shared<const LevelCore>(core));
  }
  void add_effort(std::int64_t steps) override {
    effort_ += steps;
    exchange();
  }

  // sat::YieldPoint
  void yield() override {
    exchange();
    if (plan_ && outcome_.lower_bound < plan_cost_ &&
        is_within_gap(options_.gap_percent, plan_cost_, outcome_.lower_bound))
      limits_.stop(StopReason::gap);
    tell_known();
    progress_.tell_if_due();
    const double now = limits_.elapsed_wall();
    if (options_.on_plan && plan_ && plan_cost_ != told_cost_ && now >= next_plan_s_) {
      options_.on_plan(*plan_);
      told_cost_ = plan_cost_;
      next_plan_s_ = now + options_.plan_interval_s;
    }
  }

  /// There is a plan that is cheaper than what the user knows; who called this tells that.
  [[nodiscard]] bool is_bound_refuted() const {
    const Plan* const plan = outcome_.plan ? &*outcome_.plan : plan_.get();
    return plan != nullptr && refuse_bound(options_.known_lower_bound, cost_of(*plan)).has_value();
  }

  void tell_known() {
    progress_.know(outcome_.lower_bound, plan_ ? std::optional<Cost>(plan_cost_) : std::nullopt);
  }

  void exchange() {
    if (companion_ == nullptr) return;
    const std::int64_t effort = effort_ + (engine_ != nullptr ? engine_->effort() : 0);
    const auto news = companion_->on_effort(effort, [this] { return tell(); });
    if (!news) return;
    outcome_.lower_bound = std::max(outcome_.lower_bound, news->lower);
    heard_.lower = std::max(heard_.lower, news->lower);
    if (news->plan && (!plan_ || news->cost < plan_cost_)) {
      keep(news->plan, news->cost);
      heard_.plan = news->plan;
      heard_.cost = news->cost;
    }
    // The others are told of a search the same things again and again, and some more.
    for (const News::Cores& told : news->cores) {
      if (num_heard_.size() <= told.teller) num_heard_.resize(told.teller + 1, 0);
      std::size_t& num_heard = num_heard_[told.teller];
      if (num_heard >= told.list.size()) continue;
      heard_.cores.push_back(
          {told.teller,
           {told.list.begin() + static_cast<std::ptrdiff_t>(num_heard), told.list.end()}});
      num_heard = told.list.size();
    }
    if (plan_ && outcome_.lower_bound > plan_cost_ && !is_bound_refuted())
      outcome_.internal_error = Error{ErrorCode::internal, "a plan costs less than the bound", {}};
  }

  [[nodiscard]] News tell() const {
    News news;
    if (outcome_.internal_error) return news;
    news.lower = outcome_.lower_bound;
    news.plan = plan_;
    news.cost = plan_cost_;
    news.cores.push_back({companion_->worker(), cores_});
    return news;
  }

  const SolveOptions& options_;
  const CostReport& known_;
  const Inheritance& inheritance_;
  LimitMonitor& limits_;
  Companion* const companion_;
  SolveOutcome outcome_;
  const sat::Engine* engine_ = nullptr;
  std::int64_t effort_ = 0;           // besides the engine's
  std::shared_ptr<const Plan> plan_;  // the best one
  Cost plan_cost_ = 0;
  std::vector<std::shared_ptr<const LevelCore>> cores_;
  std::vector<LevelCore> learned_cores_;  // to be left
  News heard_;                            // and not yet passed on to the search
  std::vector<std::size_t> num_heard_;    // cores, by teller
  std::optional<Cost> told_cost_;
  ProgressReporter progress_;
  double next_plan_s_ = 0;
};

}  // namespace

SolveOutcome search_alone(Scene& scene, const SolveOptions& options, const CostReport& known,
                          LimitMonitor& limits, Companion* companion,
                          const Inheritance& inheritance) {
  return CostRun(options, known, inheritance, limits, companion).run(scene);
}

void keep_best(const SolveOptions& options, SolveOutcome& outcome) {
  outcome.status = outcome.plan ? Status::feasible : Status::unknown;
  if (outcome.plan && cost(*outcome.plan, options.objective) == outcome.lower_bound)
    outcome.status = Status::optimal;
}

}  // namespace quadrille::continuous
