// SPDX-License-Identifier: MIT
#include "quadrille/discrete/solver.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "certificate/certify.hpp"
#include "flow/one_group.hpp"
#include "mdd/mdd_model.hpp"
#include "mdd/usages.hpp"
#include "model/independent_groups.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "quadrille/discrete/verify.hpp"
#include "quadrille/solve/apart.hpp"
#include "quadrille/solve/frame.hpp"
#include "quadrille/solve/time_origin.hpp"
#include "solve/first_checks.hpp"
#include "solve/portfolio.hpp"
#include "solve/tie_break.hpp"

namespace quadrille::discrete {
namespace {

std::optional<Error> check_options(const Instance& instance, const SolveOptions& options) {
  const auto refuse = [](ErrorCode code, std::string message) {
    return Error{code, std::move(message), {}};
  };
  const std::size_t vertices = instance.graph().num_vertices();
  if (vertices > kMaxVertices)
    return refuse(ErrorCode::out_of_range,
                  "the graph has " + std::to_string(vertices) + " vertices, more than " +
                      std::to_string(kMaxVertices) + ", which are the most that can be solved");
  if (options.system != System::dpll && vertices > kMaxMddVertices)
    return refuse(ErrorCode::out_of_range,
                  "the graph has " + std::to_string(vertices) + " vertices, more than " +
                      std::to_string(kMaxMddVertices) + ", which are the most for the system " +
                      std::string(to_string(options.system)) + "; dpll takes more");
  const auto reaches = [](CheckSchedule::Fraction a, CheckSchedule::Fraction b) {
    return static_cast<std::int64_t>(a.numerator) * b.denominator >=
           static_cast<std::int64_t>(b.numerator) * a.denominator;
  };
  CheckSchedule::Fraction last{0, 1};
  for (const CheckSchedule::Fraction& f : options.mdd.check.fractions) {
    if (f.denominator <= 0 || reaches(last, f) || reaches(f, {1, 1}))
      return refuse(ErrorCode::out_of_range,
                    "the fractions of a check schedule increase between 0 and 1");
    last = f;
  }
  if (options.explain && options.system != System::dpll)
    return refuse(ErrorCode::out_of_range, "an explanation needs the system dpll");
  if (options.proof && instance.has_goal_sets())
    return refuse(ErrorCode::out_of_range,
                  "a certificate knows one goal for each agent, not sets of several");
  if (!instance.is_plain() && (options.proof || options.explain))
    return refuse(ErrorCode::out_of_range,
                  std::string(options.proof ? "a certificate" : "an explanation") +
                      " knows no rules: one-way edges, agents that leave, releases, deadlines, "
                      "waypoints, blockages, robust plans, turns");
  if (options.tie == Tie::fewest_moves) {
    if (options.gap_percent)
      return refuse(ErrorCode::out_of_range,
                    "the fewest moves are those of plans of least cost: there is no gap then");
    if (instance.has_goal_sets() || !MddModel::knows(instance))
      return refuse(ErrorCode::out_of_range,
                    "the fewest moves are not known for agents with several goals or waypoints, "
                    "nor where turns take time");
    if (vertices > kMaxMddVertices)
      return refuse(ErrorCode::out_of_range,
                    "the graph has " + std::to_string(vertices) + " vertices, more than " +
                        std::to_string(kMaxMddVertices) +
                        ", which are the most for plans with the fewest moves");
  }
  if (options.system != System::dpll && !MddModel::knows(instance))
    return refuse(ErrorCode::out_of_range, "the system " + std::string(to_string(options.system)) +
                                               " knows no waypoints and no turns; they need the "
                                               "system dpll");
  return std::nullopt;
}

/// Edges of time-expanded graphs, for flows before the search: a few seconds.
constexpr std::int64_t kMostFlowSteps = 300'000'000;

/// For the makespan of agents that share goals: what each group of them takes at least, and where
/// there is no other agent, a plan. True if that is all there is to know.
bool is_closed_by_flow(const Instance& instance, const SolveOptions& options, LimitMonitor& limits,
                       Knowledge& known) {
  if (options.objective != Objective::makespan || options.explain || !instance.is_plain())
    return false;
  for (const std::vector<AgentId>& group : groups_that_share(instance)) {
    GroupMakespan flow = least_makespan(instance, group, kMostFlowSteps, limits);
    known.prove(flow.lower);
    if (flow.paths && group.size() == instance.num_agents()) {
      Plan plan{IdVector<AgentId, Path>(*std::move(flow.paths))};
      trim(plan);
      known.offer(std::make_shared<const Plan>(std::move(plan)), flow.lower);
      known.credit("flow");
    }
  }
  return known.cost && *known.cost <= known.lower();
}

/// What solve::search_from_0 asks for.
class Border {
 public:
  explicit Border(const Instance& instance) : instance_(instance) {}

  [[nodiscard]] bool begins_at_0() const { return instance_.now() == 0; }
  [[nodiscard]] const Instance& instance() const { return instance_; }
  [[nodiscard]] Instance since_now() const { return instance_.since_now(); }
  [[nodiscard]] VerifyReport verify(const Plan& plan) const {
    return discrete::verify(instance_, plan);
  }
  static void enter(Plan& plan) { plan.now = 0; }
  void leave(Plan& plan) const { plan.now = instance_.now(); }
  [[nodiscard]] Cost now() const { return instance_.now(); }

 private:
  const Instance& instance_;
};

/// What solve::Frame asks for.
class Domain {
 public:
  using Plan = discrete::Plan;
  using Options = SolveOptions;
  using Outcome = SolveOutcome;
  using Apart = solve::Apart<Domain>;

  Domain(const Instance& instance, const SolveOptions& options, const Tuner& tuner)
      : instance_(instance), options_(options), tuner_(tuner) {
    QUADRILLE_REQUIRE(instance.now() == 0, "searches begin at 0");
  }

  [[nodiscard]] VerifyReport verify(const Plan& plan) const {
    return discrete::verify(instance_, plan);
  }
  [[nodiscard]] static Cost cost(const Plan& plan, Objective objective) {
    return plan.cost(objective);
  }
  [[nodiscard]] static Cost cost_of(const Plan& plan, AgentId agent) {
    return arrival(plan.paths[agent]);
  }
  static void tidy(Plan& plan) { trim(plan); }
  [[nodiscard]] IdRange<AgentId> agents() const { return instance_.agent_ids(); }
  [[nodiscard]] Cost free_cost(AgentId agent) const {
    const Agent& task = instance_.agents()[agent];
    const Timestep way = distances_to_nearest(instance_.graph(), task.goals)[task.start];
    return way == kUnreachable ? 0 : way;
  }

  void search(LimitMonitor& limits, const std::shared_ptr<ResourceAccount>& account,
              Knowledge& known, solve::Pulse<Plan>& pulse) {
    search_costs(limits, account, known, pulse);
    if (options_.tie == Tie::any || !known.plan || known.infeasible || known.error) return;
    moves_ = count_moves(instance_, *known.plan);
    if (*known.cost == known.lower())
      moves_ = break_tie(instance_, options_, tuner_, account, limits.conflicts(), known);
  }
  /// Those of the plan that is known in the end, if that was asked for.
  [[nodiscard]] const std::optional<Moves>& moves() const noexcept { return moves_; }

  // What solve::Apart asks for.
  [[nodiscard]] Apart::Search search_of(const std::vector<AgentId>& agents) const {
    std::vector<Agent> tasks;
    for (const AgentId i : agents) tasks.push_back(instance_.agents()[i]);
    return [this, part = instance_.with_agents(std::move(tasks)).value()](
               const SolveOptions& options, LimitMonitor& limits, Knowledge& known,
               solve::Pulse<Plan>& pulse) {
      if (is_closed_by_flow(part, options, limits, known)) return;
      solve::Exchange<Message> alone;
      ProofDraft none;
      search_side_by_side(part, options, tuner_, account_, {limits, known, pulse, alone}, none);
    };
  }
  /// Agents are named in no text of a search: whom feasibility names, it has named before.
  [[nodiscard]] static solve::Infeasibility told(solve::Infeasibility infeasibility) {
    return infeasibility;
  }

  /// Into the outcome, which is complete otherwise.
  void certify(SolveOutcome& outcome) {
    if (outcome.status == Status::infeasible) {
      outcome.certificate = certify_infeasible(instance_, options_.objective, invariant_);
    } else if (outcome.internal_error || !proof_.fault.empty()) {
      outcome.no_certificate =
          proof_.fault.empty() ? outcome.internal_error->message : std::move(proof_.fault);
    } else {
      if (!proof_.proof) proof_.proof = free_proof(floor_.value_or(bound_without_claim(outcome)));
      outcome.certificate =
          discrete::certify(instance_, options_.objective, *proof_.proof, outcome.plan);
    }
  }

 private:
  void search_costs(LimitMonitor& limits, const std::shared_ptr<ResourceAccount>& account,
                    Knowledge& known, solve::Pulse<Plan>& pulse) {
    pulse.enter(Phase::feasibility);
    if (instance_.is_plain()) {
      Feasibility feasibility = decide_feasibility(instance_, limits);
      invariant_ = feasibility.invariant;
      if (!feasibility.feasible) known.infeasible = as_answer(std::move(feasibility));
    } else {
      known.infeasible = refuted_by_rules(instance_, limits);
    }
    if (known.infeasible) return;
    account_ = account;
    // The published systems know nothing of groups, and a certificate is one for all.
    if (options_.system == System::dpll && !options_.proof) {
      const auto groups = solve::with_lone_agents_together(independent_groups(instance_));
      if (groups.size() > 1) {
        Apart(*this, options_, account, limits, known, pulse).run(groups);
        return;
      }
    }
    if (is_closed_by_flow(instance_, options_, limits, known)) return;
    solve::Exchange<Message> alone;
    search_side_by_side(instance_, options_, tuner_, account, {limits, known, pulse, alone},
                        proof_);
    if (known.has_floor) floor_ = known.floor;
  }

  /// Of a solve that a limit ended before the search began.
  [[nodiscard]] Cost bound_without_claim(const SolveOutcome& outcome) const {
    return options_.known_lower_bound ? 0 : outcome.lower_bound;
  }

  const Instance& instance_;
  const SolveOptions& options_;
  const Tuner& tuner_;
  std::shared_ptr<ResourceAccount> account_;  // of the search
  ProofDraft proof_;
  Invariant invariant_;
  std::optional<Moves> moves_;
  std::optional<Cost> floor_;  // what agents cost when each is alone
};

}  // namespace

Result<SolveOutcome> solve_tuned(const Instance& instance, const SolveOptions& options,
                                 const Tuner& tuner) {
  if (auto error = check_options(instance, options)) return *std::move(error);
  const auto search = [&](const Instance& from_0, const SolveOptions& asked) {
    Domain domain(from_0, asked, tuner);
    auto outcome = solve::Frame<Domain>(domain, asked).solve();
    if (outcome && outcome->plan) outcome->moves = domain.moves();
    if (outcome && asked.proof) domain.certify(outcome.value());
    return outcome;
  };
  return solve::search_from_0(Border(instance), options, search);
}

Result<SolveOutcome> solve(const Instance& instance, const SolveOptions& options) {
  return solve_tuned(instance, options, tuner_for(instance));
}

}  // namespace quadrille::discrete
