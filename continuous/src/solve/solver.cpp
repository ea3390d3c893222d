// SPDX-License-Identifier: MIT
#include "quadrille/continuous/solver.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "feasibility/bottleneck.hpp"
#include "feasibility/feasibility.hpp"
#include "paths/scene.hpp"
#include "primal/first_plan.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/core/plan_claim.hpp"
#include "routes/route_search.hpp"
#include "solve/cost_run.hpp"
#include "solve/portfolio.hpp"
#include "solve/small_instances.hpp"

namespace quadrille::continuous {
namespace {

std::optional<Error> check_options(const Instance& instance, const SolveOptions& options) {
  if (options.seed > 2'000'000'000)
    return Error{ErrorCode::out_of_range, "the seed is larger than 2000000000", {}};
  if (options.gap_percent && !(*options.gap_percent >= 0))
    return Error{ErrorCode::out_of_range, "the gap is not a number of at least 0", {}};
  if (options.threads < 1 || options.threads > kMaxThreads)
    return Error{ErrorCode::out_of_range, "the number of threads is not from 1 to 64", {}};
  if (options.explain && options.threads > 1)
    return Error{ErrorCode::out_of_range, "an explanation needs one thread", {}};
  if (!(options.progress_interval_s >= 0))
    return Error{
        ErrorCode::out_of_range, "the progress interval is not a number of at least 0", {}};
  if (!(options.plan_interval_s >= 0))
    return Error{ErrorCode::out_of_range, "the plan interval is not a number of at least 0", {}};
  std::optional<Error> error;
  if (options.initial_plan)
    error = refuse_invalid(verify(instance, *options.initial_plan), "initial plan");
  if (!error && options.debug.known_plan)
    error = refuse_invalid(verify(instance, *options.debug.known_plan), "known plan");
  return error;
}

/// What the outcome says of agents that block each other.
void report_blocked(const Instance& instance, const std::vector<AgentId>& blocked,
                    SolveOutcome& outcome) {
  const bool are_all = blocked.size() == instance.num_agents();
  std::string text = are_all && blocked.size() > 2 ? "the agents" : "agents";
  if (!are_all || blocked.size() == 2)
    for (const AgentId i : blocked)
      text += (i == blocked.front() ? " " : " and ") + std::to_string(i.index());
  text += blocked.size() == 2 ? " cannot both" : " cannot all";
  text += " reach their goals";
  if (!are_all) text += ", even without the others";
  outcome.status = Status::infeasible;
  outcome.blocked = blocked;
  outcome.bottleneck = find_bottleneck(instance, blocked);
  const std::string where = describe_bottleneck(instance, blocked, outcome.bottleneck);
  outcome.explanation = where.empty() ? text : text + ": " + where;
}

void keep_cheaper(std::optional<Plan>& best, std::optional<Plan> plan, Objective objective) {
  if (plan && (!best || cost(*plan, objective) < cost(*best, objective))) best = std::move(plan);
}

/// What the agents cost when each is alone. Requires that all can reach their goals then.
Cost free_bound(const Scene& scene, Objective objective) {
  Cost bound = 0;
  for (const AgentId i : scene.instance().agent_ids())
    bound = objective == Objective::sum_of_costs ? bound + scene.free_cost(i)
                                                 : std::max(bound, scene.free_cost(i));
  return bound;
}

Attribution free_charges(const Scene& scene, Objective objective) {
  Attribution attribution;
  attribution.objective = objective;
  attribution.free_bound = free_bound(scene, objective);
  for (const AgentId i : scene.instance().agent_ids())
    attribution.agents.push_back({scene.free_cost(i), {}});
  return attribution;
}

/// That the agents were searched together up to the bound.
void charge_search(Attribution& attribution, Cost bound) {
  attribution.raises.clear();
  if (bound == attribution.free_bound) return;
  Raise raise{RaiseKind::search, bound - attribution.free_bound, {}, {}};
  for (const AgentId i : IdRange<AgentId>(attribution.agents.size())) raise.agents.push_back(i);
  attribution.raises.push_back(std::move(raise));
}

/// The charges, with what a search by clauses has traced. Memory may have run out before that.
void take_traced(Attribution charges, SolveOutcome& outcome) {
  if (outcome.attribution) {
    charges.raises = std::move(outcome.attribution->raises);
    charges.sites = std::move(outcome.attribution->sites);
  }
  outcome.attribution = std::move(charges);
}

void complete(Attribution& attribution, const SolveOutcome& outcome) {
  attribution.lower_bound = outcome.lower_bound;
  if (outcome.plan)
    for (const AgentId i : IdRange<AgentId>(attribution.agents.size()))
      attribution.agents[i].cost = cost(outcome.plan->paths[i]);
  fit_to_bound(attribution);
}

/// What a plan costs at most, by the deadlines.
Cost most_cost(const Instance& instance, Objective objective) {
  Cost most = 0;
  for (const AgentId i : instance.agent_ids()) {
    const Cost own = as_cost(arrival_bound(instance, i) - 1);
    most =
        objective == Objective::sum_of_costs ? std::min(most + own, kAnyCost) : std::max(most, own);
  }
  return most;
}

void find_plan(const Instance& instance, const SolveOptions& options, LimitMonitor& limits,
               const std::shared_ptr<ResourceAccount>& account, SolveOutcome& outcome) {
  std::optional<Plan> some_plan = outcome.plan = options.initial_plan;
  keep_best(options, outcome);  // the answer if a limit is met
  Scene scene(instance, limits);
  if (!scene.is_complete()) return;
  const auto is_blocked = [&](const std::vector<AgentId>& blocked) {
    if (!blocked.empty()) report_blocked(instance, blocked, outcome);
    return !blocked.empty();
  };
  for (const AgentId i : instance.agent_ids()) {
    if (scene.free_cost(i) < kAnyCost) continue;
    outcome.status = Status::infeasible;
    outcome.blocked = {i};
    outcome.explanation =
        "agent " + std::to_string(i.index()) + " cannot get past the moving obstacles" +
        (instance.agent(i).deadline ? " by its deadline" : "") + ", even without other agents";
    return;
  }
  Cost floor = outcome.lower_bound = free_bound(scene, options.objective);
  if (options.explain) outcome.attribution = free_charges(scene, options.objective);
  /// Whether that is all.
  const auto learn = [&](Cost bound, std::optional<Plan> plan) {
    floor = outcome.lower_bound = std::max(floor, bound);
    if (outcome.attribution) charge_search(*outcome.attribution, floor);
    keep_cheaper(some_plan, std::move(plan), options.objective);
    outcome.plan = some_plan;  // the answer if a limit is met
    if (floor > most_cost(instance, options.objective)) {
      outcome.status = Status::infeasible;
      outcome.explanation = "no plan keeps all deadlines";
      return true;
    }
    if (!some_plan || cost(*some_plan, options.objective) != floor) return false;
    outcome.status = Status::optimal;
    return true;
  };
  const bool is_joint_first =
      options.joint_work > 0 && options.system == System::dpll && is_small(instance);
  if (is_joint_first) {
    SmallReport report = search_small_instance(scene, options.objective, options.joint_work);
    if (is_blocked(report.blocked) || learn(report.lower_bound, std::move(report.plan))) return;
  }
  if (options.route_work > 0 && options.system == System::dpll &&
      instance.num_agents() <= kMaxRouteAgents) {
    auto routes = search_routes(scene, options.objective, options.route_work);
    if (learn(routes.lower_bound, std::move(routes.plan))) return;
  }
  if (!some_plan || is_joint_first)
    keep_cheaper(some_plan, find_first_plan(scene), options.objective);
  if (!some_plan && !is_joint_first) {
    Feasibility feasibility = check_feasibility(scene);
    if (is_blocked(feasibility.blocked)) return;
    some_plan = std::move(feasibility.plan);
  }
  outcome.plan = some_plan;  // the answer if a limit is met
  const CostReport known{sat::SearchEnd::stopped, floor, std::move(some_plan)};
  std::optional<Attribution> charges = std::move(outcome.attribution);
  outcome = options.threads > 1 ? search_side_by_side(scene, options, known, limits, account)
                                : search_alone(scene, options, known, limits, nullptr);
  if (charges) take_traced(*charges, outcome);
}

/// What is claimed must not contradict a plan that the user gave.
void check_known_plan(const Plan& plan, const SolveOptions& options, SolveOutcome& outcome) {
  const Cost known = cost(plan, options.objective);
  if (outcome.status == Status::infeasible)
    outcome.internal_error = Error{ErrorCode::internal, "infeasible, but a plan is known", {}};
  else if (known < outcome.lower_bound)
    outcome.internal_error =
        Error{ErrorCode::internal,
              "the known plan costs " + std::to_string(known) + " and the proven bound is " +
                  std::to_string(outcome.lower_bound),
              {}};
}

/// The plan has to pass `verify` and to cost what was proved.
void check_plan(const Instance& instance, const SolveOptions& options, SolveOutcome& outcome) {
  hold_to_replay(verify(instance, *outcome.plan), options.objective, outcome);
}

/// Fills in what was found and proved, and checks its plan. Throws what callbacks throw.
void answer(const Instance& instance, const SolveOptions& options, LimitMonitor& limits,
            const std::shared_ptr<ResourceAccount>& account, SolveOutcome& outcome) {
  try {
    try {
      find_plan(instance, options, limits, account, outcome);
    } catch (const LimitReached&) {
      keep_best(options, outcome);
    } catch (const std::bad_alloc&) {
      // The search's memory is free again: the bound and the best plan are the answer.
      outcome.stop = StopReason::memory;
      keep_best(options, outcome);
    }
    if (outcome.plan && !outcome.internal_error) check_plan(instance, options, outcome);
  } catch (const std::bad_alloc&) {
    outcome.stop = StopReason::memory;
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
  }
  if (outcome.status == Status::optimal || outcome.status == Status::infeasible)
    outcome.stop = StopReason::none;
}

std::string stop_text(StopReason reason) {
  if (reason == StopReason::gap) return "the gap is as small as was asked for";
  if (reason == StopReason::memory) return "no more memory";  // short: needs no memory itself
  return "stopped by a limit: " + std::string(to_string(reason));
}

}  // namespace

std::string_view to_string(System system) noexcept {
  return system == System::dpll ? "dpll" : "smt-cbs";
}

std::optional<System> parse_system(std::string_view text) noexcept {
  for (const System system : {System::dpll, System::smt_cbs})
    if (text == to_string(system)) return system;
  return std::nullopt;
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options) {
  if (auto error = check_options(instance, options)) return *std::move(error);
  SolveOutcome outcome;
  const auto account = std::make_shared<ResourceAccount>();
  LimitMonitor limits(options.limits, account);
  answer(instance, options, limits, account, outcome);
  for (const auto* plan : {&options.initial_plan, &options.debug.known_plan})
    if (*plan && !outcome.internal_error) check_known_plan(**plan, options, outcome);
  if (outcome.internal_error) {
    outcome.status = Status::unknown;
    outcome.plan.reset();
    outcome.cost.reset();
    outcome.explanation = outcome.internal_error->message;
    outcome.attribution.reset();
  } else if (outcome.status == Status::unknown || outcome.status == Status::feasible) {
    if (outcome.stop == StopReason::none) outcome.stop = limits.reason();
    outcome.explanation = stop_text(outcome.stop);
  }
  if (outcome.status == Status::infeasible) outcome.attribution.reset();
  if (outcome.attribution) complete(*outcome.attribution, outcome);
  outcome.statistics.cpu_s = limits.elapsed_cpu();
  outcome.statistics.wall_s = limits.elapsed_wall();
  outcome.statistics.peak_rss_mib = peak_rss_mib();
  return outcome;
}

}  // namespace quadrille::continuous
