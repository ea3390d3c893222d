// SPDX-License-Identifier: MIT
#include "solve/cost_run.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "quadrille/core/free_bound.hpp"
#include "quadrille/sat/proof_log.hpp"
#include "solve/cost_problem.hpp"
#include "solve/cover_search.hpp"
#include "solve/lemma_keeper.hpp"
#include "solve/makespan_search.hpp"
#include "theory/collision_sites.hpp"
#include "theory/lemma_auditor.hpp"
#include "theory/theory.hpp"

namespace quadrille::continuous {
namespace {

class CostRun final : private sat::YieldPoint, private Correspondent {
 public:
  CostRun(const SolveOptions& options, const Desk& desk, const WarmStart& warm,
          std::optional<ProofDraft>& proof)
      : options_(options),
        warm_(warm),
        proof_(proof),
        limits_(desk.limits),
        known_(desk.known),
        pulse_(desk.pulse),
        exchange_(desk.exchange) {}

  void run(Scene& scene) {
    scene_ = &scene;
    pulse_.enter(Phase::search);
    Model model(scene);
    ContinuousTheory theory(model);
    std::optional<LemmaAuditor> auditor;
    if (options_.debug.audit || options_.debug.known_plan)
      auditor.emplace(model, options_.debug.audit, options_.debug.known_plan);
    const bool in_search = options_.system == System::dpll;
    sat::EngineOptions engine_options;
    engine_options.seed = options_.seed;
    engine_options.effort_of_conflict = Effort::microseconds(15);
    engine_options.observer = auditor ? &*auditor : nullptr;
    std::optional<lazy::Recorder> recorder;
    if (options_.explain) {
      recorder.emplace(model, model.instance().num_agents(), engine_options.observer);
      engine_options.observer = &*recorder;
    }
    std::optional<LemmaKeeper> keeper;
    if (warm_.learned_after != nullptr) {
      keeper.emplace(model, engine_options.observer);
      engine_options.observer = &*keeper;
    }
    std::optional<sat::ProofLog> log;
    if (options_.proof) {
      log.emplace(engine_options.observer);
      engine_options.observer = engine_options.proof = &*log;
      engine_options.derivations = &*log;
    }
    sat::Engine engine(in_search ? &theory : nullptr, engine_options);
    engine_ = &engine;
    CostProblem problem(model, engine, theory, in_search, this,
                        auditor ? auditor->cores() : nullptr);
    const Cost spared = options_.debug.known_plan ? cost_of(*options_.debug.known_plan) : 0;
    CostTrace trace;
    CostTrace* const traced = recorder ? &trace : nullptr;
    std::vector<ProvedCover> covers;
    const auto conclude = [&](bool has_plan) {
      if (log) keep_proof(model, engine, covers);
      if (keeper) leave(*keeper);
      if (recorder) explain(model, *recorder, std::move(trace), has_plan);
      engine.add_statistics(known_.statistics);
      known_.statistics.checks = theory.num_checks();
      engine_ = nullptr;
    };
    CostReport report;
    try {
      lazy::EngineWriter writer(engine);
      take_up(warm_.learned.lemmas, model, writer);
      const CostReport begin{sat::SearchEnd::stopped, known_.lower(),
                             known_.plan ? std::optional<Plan>(*known_.plan) : std::nullopt};
      report = options_.objective == Objective::sum_of_costs
                   ? search_by_covers({problem, begin, spared, exchange_.role(), options_.seed,
                                       limits_, known_.statistics, *this, warm_.learned.cores,
                                       traced, log ? &covers : nullptr})
                   : search_makespan(problem, begin, limits_, known_.statistics, *this, traced);
    } catch (const LimitReached&) {
      conclude(known_.plan != nullptr);
      throw;
    }
    conclude(known_.plan || report.plan);
    take(report);
    if (const auto complaint = auditor ? auditor->complaint() : std::nullopt)
      known_.fail(*complaint);
    else if (report.end == sat::SearchEnd::exhausted)
      known_.infeasible = solve::Infeasibility{"every combination of paths collides"};
    else if (report.end == sat::SearchEnd::found && known_.cost != known_.lower() &&
             !known_.is_claim_refuted())
      known_.fail("the plan found does not cost the proven bound");
  }

 private:
  void explain(const Model& model, const lazy::Recorder& recorder, CostTrace trace, bool has_plan) {
    sat::Dependence dependence = recorder.dependence(has_plan);
    for (CoreUse& core : trace.cores) dependence.imply(core.agents, std::move(core.ceilings));
    for (Raise& raise : trace.raises) dependence.add_bystanders(raise);
    if (!known_.attribution) known_.attribution.emplace();
    known_.attribution->raises = std::move(trace.raises);
    known_.attribution->sites = collision_sites(model, recorder);
  }

  void keep_proof(Model& model, const sat::Engine& engine, const std::vector<ProvedCover>& covers) {
    const auto free_cost = [&](AgentId i) { return model.free_cost(i); };
    const Cost floor = free_bound(model.instance().agent_ids(), options_.objective, free_cost);
    proof_ = draft_proof(model, engine, covers, options_.objective, floor);
  }

  void leave(const LemmaKeeper& keeper) {
    Learned learned{keeper.stock(), std::move(learned_cores_)};
    *warm_.learned_after = std::move(learned);
  }

  [[nodiscard]] Cost cost_of(const Plan& plan) const {
    return scene_->cost(plan, options_.objective);
  }

  void take(const CostReport& report) {
    known_.raise(report.lower_bound);
    if (!report.plan) return;
    const Cost cost = cost_of(*report.plan);
    if (!known_.cost || cost < *known_.cost)
      known_.take(std::make_shared<const Plan>(*report.plan), cost);
  }

  // Correspondent
  Message report(const CostReport& report) override {
    take(report);
    yield();
    return std::exchange(heard_, {});
  }
  void report_core(const LevelCore& core) override {
    if (warm_.learned_after != nullptr) learned_cores_.push_back(core);
    if (exchange_.has_others() && !options_.debug.audit && !options_.proof)
      cores_.push_back(std::make_shared<const LevelCore>(core));
  }
  void add_effort(Effort effort) override {
    effort_ += effort;
    exchange();
  }

  // sat::YieldPoint
  void yield() override {
    exchange();
    pulse_.beat();
  }

  void exchange() {
    const Effort effort = effort_ + (engine_ != nullptr ? engine_->effort() : Effort());
    const auto heard = exchange_.arrive(effort, [this] { return message(); });
    if (!heard) return;
    known_.raise(heard->lower);
    heard_.lower = std::max(heard_.lower, heard->lower);
    if (heard->plan && known_.offer(heard->plan, heard->cost)) {
      heard_.plan = heard->plan;
      heard_.cost = heard->cost;
    }
    // The others are told of a search the same things again and again, and some more.
    for (const ToldCores::Of& told : heard->extra.all) {
      if (num_heard_.size() <= told.teller) num_heard_.resize(told.teller + 1, 0);
      std::size_t& num_heard = num_heard_[told.teller];
      if (num_heard >= told.list.size()) continue;
      heard_.extra.all.push_back(
          {told.teller,
           {told.list.begin() + static_cast<std::ptrdiff_t>(num_heard), told.list.end()}});
      num_heard = told.list.size();
    }
  }

  [[nodiscard]] Message message() const {
    Message message;
    // What is wrong must not be believed.
    if (known_.cost && *known_.cost < known_.lower() && !known_.is_claim_refuted()) return message;
    message.lower = known_.lower();
    message.plan = known_.plan;
    message.cost = known_.cost.value_or(0);
    message.extra.all.push_back({exchange_.worker(), cores_});
    return message;
  }

  const SolveOptions& options_;
  const WarmStart& warm_;
  std::optional<ProofDraft>& proof_;
  LimitMonitor& limits_;
  Knowledge& known_;
  solve::Pulse<Plan>& pulse_;
  Exchange& exchange_;
  const Scene* scene_ = nullptr;
  const sat::Engine* engine_ = nullptr;
  Effort effort_;  // besides the engine's
  std::vector<std::shared_ptr<const LevelCore>> cores_;
  std::vector<LevelCore> learned_cores_;  // to be left
  Message heard_;                         // and not yet passed on to the search
  std::vector<std::size_t> num_heard_;    // cores, by teller
};

}  // namespace

void search_costs(Scene& scene, const SolveOptions& options, const Desk& desk,
                  const WarmStart& warm, std::optional<ProofDraft>& proof) {
  CostRun(options, desk, warm, proof).run(scene);
}

}  // namespace quadrille::continuous
