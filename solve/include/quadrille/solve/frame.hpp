// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "quadrille/core/export.hpp"
#include "quadrille/core/free_bound.hpp"
#include "quadrille/core/request.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/solve/knowledge.hpp"
#include "quadrille/solve/pulse.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::solve {

/// The error (out_of_range) for what is wrong with the numbers of a request.
[[nodiscard]] std::optional<Error> check_numbers(const Choices& choices);

/// The error (invalid_plan) for a plan that a user claims to be valid, if a replay found violations
/// in it. `what`: what it is called, such as "initial plan".
template <class VerifyReport>
[[nodiscard]] std::optional<Error> refuse_invalid(const VerifyReport& report,
                                                  const std::string& what) {
  if (report.valid()) return std::nullopt;
  return Error{
      ErrorCode::invalid_plan,
      "the " + what + " is not a plan of this instance: " + report.violations.front().message,
      {}};
}

/// What the agents cost when each is alone: an attribution that knows no more. `free_cost(i)`: of
/// one.
template <class FreeCost>
[[nodiscard]] Attribution free_charges(IdRange<AgentId> agents, Objective objective,
                                       const FreeCost& free_cost) {
  Attribution attribution;
  attribution.objective = objective;
  for (const AgentId i : agents) attribution.agents.push_back({free_cost(i), {}});
  attribution.free_bound = free_bound(agents, objective, free_cost);
  return attribution;
}

/// Of a replay that found no violations.
template <class VerifyReport>
[[nodiscard]] Cost cost_of(const VerifyReport& report, Objective objective) {
  return objective == Objective::sum_of_costs ? report.sum_of_costs : report.makespan;
}

/// What is wrong with a request; `verify(plan)` is the domain's replay. Errors: out_of_range,
/// invalid_plan.
template <class Plan, class Verify>
[[nodiscard]] std::optional<Error> check_request(const Request<Plan>& request,
                                                 const Verify& verify) {
  const auto refuse = [](const char* message) {
    return Error{ErrorCode::out_of_range, message, {}};
  };
  if (auto error = check_numbers(request)) return error;
  if (!(request.progress_interval_s >= 0))
    return refuse("the progress interval is not a number of at least 0");
  if (!(request.plan_interval_s >= 0))
    return refuse("the plan interval is not a number of at least 0");
  if (request.explain && request.threads > 1) return refuse("an explanation needs one thread");
  if (request.known_lower_bound && *request.known_lower_bound < 0)
    return refuse("the known lower bound is negative, or out of range");
  if (request.initial_plan) {
    const auto report = verify(*request.initial_plan);
    if (auto error = refuse_invalid(report, "initial plan")) return error;
    if (auto error =
            refuse_bound(request.known_lower_bound.value_or(0), cost_of(report, request.objective)))
      return error;
  }
  if (request.debug.known_plan)
    return refuse_invalid(verify(*request.debug.known_plan), "known plan");
  return std::nullopt;
}

/// Begins with the plans that the user gave.
template <class Domain>
void take_given_plans(const Domain& domain, const Request<typename Domain::Plan>& request,
                      Knowledge<typename Domain::Plan>& known) {
  using Plan = typename Domain::Plan;
  for (const auto* plan : {&request.initial_plan, &request.debug.known_plan})
    if (*plan) {
      const Cost cost = domain.cost(**plan, request.objective);
      known.given = std::min(cost, known.given.value_or(cost));
    }
  if (!request.initial_plan) return;
  Plan plan = *request.initial_plan;
  domain.tidy(plan);
  const Cost cost = domain.cost(plan, request.objective);
  known.take(std::make_shared<const Plan>(std::move(plan)), cost);
  known.credit("given");
}

/// One solve from the request to the outcome, in both domains. `Domain` supplies what differs:
///
///     Plan, Outcome                     types
///     verify(plan)                      its replay
///     cost(plan, objective)
///     tidy(plan)                        changes nothing but how it is written
///     agents(), cost_of(plan, agent)
///     free_cost(agent)                  what it costs at least when it is alone, fast
///     search(limits, account, known, pulse)    finds out what there is to know
///
/// Errors: those of check_request, and out_of_range for a known lower bound that a plan refutes.
/// Throws what callbacks throw, and std::bad_alloc if there is no memory even for the outcome.
template <class Domain>
class Frame {
 public:
  using Plan = typename Domain::Plan;
  using Outcome = typename Domain::Outcome;

  Frame(Domain& domain, const Request<Plan>& request) : domain_(domain), request_(request) {}

  [[nodiscard]] Result<Outcome> solve() {
    const auto verify = [this](const Plan& plan) { return domain_.verify(plan); };
    if (auto error = check_request(request_, verify)) return *std::move(error);
    const auto account = std::make_shared<ResourceAccount>();
    LimitMonitor limits(request_.limits, account);
    Knowledge<Plan> known;
    known.claimed = request_.known_lower_bound.value_or(0);
    Outcome outcome;
    {
      Pulse<Plan> pulse(request_, limits, known, true);
      run_guarded(known, limits, [&] {
        take_given_plans(domain_, request_, known);
        domain_.search(limits, account, known, pulse);
      });
    }
    // However early it was cut, this much is known in little time.
    if (!known.has_floor && !known.infeasible)
      run_guarded(known, limits, [&] {
        Grace grace(request_.limits, limits);
        const auto free_cost = [this](AgentId i) { return domain_.free_cost(i); };
        known.prove(free_bound(domain_.agents(), request_.objective, free_cost, &grace));
      });
    run_guarded(known, limits, [&] { replay(known, outcome); });
    if (!outcome.plan) known.drop_plan();
    known.credit("search");
    if (!known.plan) known.statistics.first_plan.clear();
    fill(known, outcome);
    if (outcome.internal_error && outcome.internal_error->code == ErrorCode::out_of_range)
      return *std::move(outcome.internal_error);
    outcome.statistics.cpu_s = limits.elapsed_cpu();
    outcome.statistics.wall_s = limits.elapsed_wall();
    outcome.statistics.peak_rss_mib = peak_rss_mib();
    return outcome;
  }

 private:
  /// Nothing is given out that does not stand a replay, by code that shares nothing with the
  /// search.
  void replay(Knowledge<Plan>& known, Outcome& outcome) {
    if (!known.plan || known.error) return;
    Plan plan = *known.plan;
    domain_.tidy(plan);
    const auto report = domain_.verify(plan);
    const Cost cost = solve::cost_of(report, request_.objective);
    if (!report.valid())
      known.fail("the plan is not valid: " + report.violations.front().message);
    else if (cost != known.cost)
      known.fail("the plan costs " + std::to_string(cost) + " and was said to cost " +
                 std::to_string(*known.cost));
    outcome.plan = std::move(plan);
  }

  void fill(Knowledge<Plan>& known, Outcome& outcome) {
    Settlement settled = settle(known, request_.gap_percent);
    outcome.status = settled.status;
    outcome.stop = settled.stop;
    outcome.explanation = std::move(settled.explanation);
    outcome.internal_error = std::move(settled.error);
    outcome.rests_on_known_bound = settled.rests_on_claim;
    outcome.statistics = known.statistics;
    outcome.cost = known.cost;
    if (settled.status != Status::infeasible) outcome.lower_bound = known.lower();
    if (settled.status == Status::infeasible || settled.status == Status::unknown) {
      outcome.plan.reset();
      outcome.cost.reset();
    }
    if (settled.status == Status::infeasible) {
      outcome.blocked = std::move(known.infeasible->blocked);
      outcome.bottleneck = std::move(known.infeasible->bottleneck);
    } else if (known.attribution && !outcome.internal_error) {
      outcome.attribution = complete(*std::move(known.attribution), outcome);
    }
  }

  [[nodiscard]] Attribution complete(Attribution attribution, const Outcome& outcome) const {
    attribution.lower_bound = outcome.lower_bound;
    if (outcome.plan)
      for (const AgentId i : IdRange<AgentId>(attribution.agents.size()))
        attribution.agents[i].cost = domain_.cost_of(*outcome.plan, i);
    fit_to_bound(attribution);
    return attribution;
  }

  Domain& domain_;
  const Request<Plan>& request_;
};

}  // namespace quadrille::solve

QUADRILLE_API_END
