// SPDX-License-Identifier: MIT
#include "solve/run.hpp"

#include <utility>

#include "certificate/lazy_meanings.hpp"
#include "certificate/mdd_meanings.hpp"
#include "lazy/collision_sites.hpp"
#include "lazy/lazy_auditor.hpp"
#include "lazy/lazy_model.hpp"
#include "lazy/lazy_problem.hpp"
#include "lazy/lazy_theory.hpp"
#include "mdd/collision_theory.hpp"
#include "mdd/eager_collisions.hpp"
#include "mdd/fewest_moves.hpp"
#include "mdd/lemma_auditor.hpp"
#include "mdd/mdd_model.hpp"
#include "mdd/mdd_problem.hpp"
#include "paths/lone_agents.hpp"
#include "quadrille/sat/proof_log.hpp"

namespace quadrille::discrete {
namespace {

/// With a log of the proof, which is made if one is wanted.
sat::EngineOptions engine_options(const SolveOptions& options, const Tuning& tuning,
                                  sat::ClauseObserver* observer,
                                  std::optional<sat::ProofLog>& log) {
  sat::EngineOptions engine_options;
  engine_options.seed = options.seed;
  // Usages are negated variables.
  engine_options.initial_phase = options.lazy.forbid_first && options.system == System::dpll;
  engine_options.chronological = tuning.chronological;
  engine_options.bump_reasons = tuning.bump_reasons;
  engine_options.keep_clauses = tuning.cores.from_above;
  engine_options.observer = observer;
  if (options.proof) {
    log.emplace(observer);
    engine_options.observer = engine_options.proof = &*log;
    engine_options.derivations = &*log;
  }
  return engine_options;
}

class MddRun final : public Run {
 public:
  MddRun(const Instance& instance, const SolveOptions& options, const Tuning& tuning)
      : growth_(options.mdd.growth), model_(instance, options.objective) {
    if (options.system == System::dpll_mdd)
      theory_ = std::make_unique<CollisionTheory>(model_, options.mdd.check);
    if (options.system == System::mdd_sat) eager_ = std::make_unique<EagerCollisions>(model_);
    if (options.debug.audit || options.debug.known_plan)
      auditor_ = std::make_unique<LemmaAuditor>(model_, options.debug.audit && instance.is_plain(),
                                                options.debug.known_plan);
    engine_ = std::make_unique<sat::Engine>(theory_.get(),
                                            engine_options(options, tuning, auditor_.get(), log_));
  }

  bool prepare(std::shared_ptr<const GoalDistances> distances, const PricedGoals*,
               LimitMonitor& limits) override {
    const Instance& instance = model_.instance();
    IdVector<AgentId, Timestep> lone;
    if (!instance.is_plain()) lone = lone_costs(instance, *distances, limits).costs;
    if (!model_.attach(*engine_, limits, std::move(lone))) return false;
    problem_ = std::make_unique<MddProblem>(model_, *engine_, theory_.get(), eager_.get(), growth_);
    return true;
  }

  sat::Engine& engine() override { return *engine_; }
  const sat::Engine& engine() const override { return *engine_; }
  sat::CostProblem& problem() override { return *problem_; }
  std::unique_ptr<sat::CostProblem> fewest_moves(Cost cost) override {
    return std::make_unique<FewestMoves>(model_, *problem_, *engine_, cost);
  }
  const Plan& plan() const override { return problem_->plan(); }
  std::int64_t num_checks() const override {
    return problem_->num_checks() + (theory_ ? theory_->num_checks() : 0);
  }
  std::int64_t num_rejected() const override { return problem_->num_rejected(); }
  std::optional<std::string> complaint() const override {
    return auditor_ ? auditor_->complaint() : std::nullopt;
  }
  Result<sat::TrimmedProof> proof() const override {
    return sat::trim_proof(*log_, MddMeanings(model_), engine_->num_variables(),
                           problem_->lower_bound());
  }

 private:
  MddGrowth growth_;
  MddModel model_;
  std::unique_ptr<CollisionTheory> theory_;
  std::unique_ptr<EagerCollisions> eager_;
  std::unique_ptr<LemmaAuditor> auditor_;
  std::optional<sat::ProofLog> log_;
  std::unique_ptr<sat::Engine> engine_;
  std::unique_ptr<MddProblem> problem_;
};

class LazyRun final : public Run {
 public:
  LazyRun(const Instance& instance, const SolveOptions& options, const Tuning& tuning)
      : instance_(instance), options_(options), tuning_(tuning) {}

  bool prepare(std::shared_ptr<const GoalDistances> distances, const PricedGoals* priced,
               LimitMonitor& limits) override {
    model_ = priced == nullptr ? std::make_unique<LazyModel>(instance_, std::move(distances))
                               : std::make_unique<LazyModel>(instance_, std::move(distances),
                                                             priced->prices, priced->left_over);
    theory_ = std::make_unique<LazyTheory>(*model_, limits, tuning_.explicit_paths);
    if (limits.exhausted_now()) return false;
    if (options_.debug.audit || options_.debug.known_plan)
      auditor_ = std::make_unique<LazyAuditor>(
          *model_, options_.debug.audit && instance_.is_plain(), options_.debug.known_plan);
    sat::ClauseObserver* observer = auditor_.get();
    if (options_.explain) {
      recorder_.emplace(*model_, instance_.num_agents(), observer);
      observer = &*recorder_;
    }
    engine_ = std::make_unique<sat::Engine>(theory_.get(),
                                            engine_options(options_, tuning_, observer, log_));
    problem_ = std::make_unique<LazyProblem>(*model_, *engine_, *theory_, options_.objective);
    return true;
  }

  sat::Engine& engine() override { return *engine_; }
  const sat::Engine& engine() const override { return *engine_; }
  sat::CostProblem& problem() override { return *problem_; }
  const Plan& plan() const override { return problem_->plan(); }
  Plan draft() const override { return theory_->draft(); }
  std::int64_t num_checks() const override { return theory_->num_checks(); }
  std::int64_t num_rejected() const override { return 0; }
  std::optional<std::string> complaint() const override {
    return auditor_ ? auditor_->complaint() : std::nullopt;
  }
  Result<sat::TrimmedProof> proof() const override {
    return sat::trim_proof(*log_, LazyMeanings(*model_), engine_->num_variables(),
                           problem_->lower_bound());
  }
  void explain(std::vector<Raise> raises, Attribution& attribution) const override {
    const sat::Dependence dependence = recorder_->dependence(true);
    for (Raise& raise : raises) dependence.add_bystanders(raise);
    attribution.raises = std::move(raises);
    attribution.sites = collision_sites(*model_, *recorder_);
  }

 private:
  const Instance& instance_;
  const SolveOptions& options_;
  const Tuning tuning_;
  std::unique_ptr<LazyModel> model_;
  std::unique_ptr<LazyTheory> theory_;
  std::unique_ptr<LazyAuditor> auditor_;
  std::optional<lazy::Recorder> recorder_;
  std::optional<sat::ProofLog> log_;
  std::unique_ptr<sat::Engine> engine_;
  std::unique_ptr<LazyProblem> problem_;
};

}  // namespace

std::unique_ptr<Run> make_run(const Instance& instance, const SolveOptions& options,
                              const Tuning& tuning) {
  if (options.system == System::dpll) return std::make_unique<LazyRun>(instance, options, tuning);
  return std::make_unique<MddRun>(instance, options, tuning);
}

}  // namespace quadrille::discrete
