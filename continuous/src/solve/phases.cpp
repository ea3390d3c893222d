// SPDX-License-Identifier: MIT
#include "solve/phases.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "feasibility/bottleneck.hpp"
#include "feasibility/feasibility.hpp"
#include "primal/first_plan.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/core/free_bound.hpp"
#include "routes/route_search.hpp"
#include "solve/cost_run.hpp"
#include "solve/portfolio.hpp"
#include "solve/small_instances.hpp"

namespace quadrille::continuous {
namespace {

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

/// What the agents cost when each is alone. Requires that all can reach their goals then.
Cost free_bound(const Scene& scene, Objective objective) {
  return quadrille::free_bound(scene.instance().agent_ids(), objective,
                               [&](AgentId i) { return scene.free_cost(i); });
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

}  // namespace

void Phases::run() {
  plan_ = outcome_.plan = options_.initial_plan;
  outcome_.lower_bound = known_;
  outcome_.rests_on_known_bound = known_ > 0;
  keep_best(options_, outcome_);  // the answer if a limit is met
  enter(Phase::set_up);
  const std::unique_ptr<Scene> made = make_scene();
  if (made == nullptr || are_kept_off(*made)) return;
  Scene& scene = *made;
  if (options_.explain) outcome_.attribution = free_charges(scene, options_.objective);
  if (learn(free_bound(scene, options_.objective), std::nullopt)) return;
  if (take_inheritance(scene)) return;
  const auto groups = options_.joint_work > 0 ? small_groups(scene) : std::vector<JointGroup>();
  const bool is_joint_first = !groups.empty();
  if (is_joint_first && search_jointly(scene, groups)) return;
  const bool is_dpll = options_.system == System::dpll;
  if (is_dpll && options_.route_work > 0 && instance_.num_agents() <= kMaxRouteAgents &&
      look_at_routes(scene))
    return;
  if (!find_some_plan(scene, is_joint_first)) search(scene);
}

std::unique_ptr<Scene> Phases::make_scene() {
  try {
    auto scene = std::make_unique<Scene>(instance_, limits_, inheritance_.store);
    if (scene->is_complete()) return scene;
  } catch (const LimitReached&) {
  } catch (const std::bad_alloc&) {
    outcome_.stop = StopReason::memory;
  }
  // What there was of it is gone, but a bound is found in little time.
  const auto alone = [&](AgentId i) {
    return as_cost(continuous::free_cost(instance_, i).value());
  };
  Grace grace(options_.limits, limits_);
  const Cost bound =
      quadrille::free_bound(instance_.agent_ids(), options_.objective, alone, &grace);
  static_cast<void>(learn(bound, std::nullopt));
  return nullptr;
}

bool Phases::are_kept_off(const Scene& scene) {
  for (const AgentId i : instance_.agent_ids()) {
    if (scene.free_cost(i) < kAnyCost) continue;
    outcome_.status = Status::infeasible;
    outcome_.blocked = {i};
    outcome_.explanation =
        "agent " + std::to_string(i.index()) + " cannot get past the moving obstacles" +
        (instance_.agent(i).deadline ? " by its deadline" : "") + ", even without other agents";
    return true;
  }
  return false;
}

Cost Phases::bound_of_all(const Scene& scene, const GroupBound& group) const {
  const bool is_sum = options_.objective == Objective::sum_of_costs;
  Cost bound = group.cost;
  for (const AgentId i : instance_.agent_ids()) {
    if (std::binary_search(group.agents.begin(), group.agents.end(), i)) continue;
    bound = is_sum ? bound + scene.free_cost(i) : std::max(bound, scene.free_cost(i));
  }
  return bound;
}

bool Phases::take_inheritance(Scene& scene) {
  for (const GroupBound& group : inheritance_.bounds)
    if (learn(bound_of_all(scene, group), std::nullopt)) return true;
  for (const auto& draft : inheritance_.drafts) {
    enter(Phase::first_plan);
    if (learn(floor_, complete_plan(scene, draft))) return true;
  }
  return false;
}

bool Phases::search_jointly(Scene& scene, const std::vector<JointGroup>& groups) {
  enter(Phase::joint_search);
  SmallReport report = search_small_groups(scene, groups, options_.objective, options_.joint_work);
  return is_blocked(report.blocked) || learn(report.lower_bound, std::move(report.plan));
}

bool Phases::look_at_routes(Scene& scene) {
  enter(Phase::routes);
  auto routes = search_routes(scene, options_.objective, options_.route_work);
  return learn(routes.lower_bound, std::move(routes.plan));
}

bool Phases::find_some_plan(Scene& scene, bool was_joint) {
  if (!plan_ || was_joint) {
    enter(Phase::first_plan);
    keep_cheaper(find_first_plan(scene));
  }
  if (!plan_ && !was_joint) {
    enter(Phase::feasibility);
    Feasibility feasibility = check_feasibility(scene);
    if (is_blocked(feasibility.blocked)) return true;
    plan_ = std::move(feasibility.plan);
  }
  outcome_.plan = plan_;  // the answer if a limit is met
  return false;
}

bool Phases::is_blocked(const std::vector<AgentId>& blocked) {
  if (!blocked.empty()) report_blocked(instance_, blocked, outcome_);
  return !blocked.empty();
}

bool Phases::learn(Cost bound, std::optional<Plan> plan) {
  floor_ = std::max(floor_, bound);
  outcome_.lower_bound = lower();
  outcome_.rests_on_known_bound = known_ > floor_;
  if (outcome_.attribution) charge_search(*outcome_.attribution, floor_);
  keep_cheaper(std::move(plan));
  outcome_.plan = plan_;  // the answer if a limit is met
  if (floor_ > most_cost(instance_, options_.objective)) {
    outcome_.status = Status::infeasible;
    outcome_.explanation = "no plan keeps all deadlines";
    return true;
  }
  if (!plan_ || cost(*plan_, options_.objective) > lower()) return false;
  keep_best(options_, outcome_);
  return true;
}

void Phases::search(Scene& scene) {
  const CostReport known{sat::SearchEnd::stopped, lower(), std::move(plan_)};
  std::optional<Attribution> charges = std::move(outcome_.attribution);
  outcome_ = options_.threads > 1
                 ? search_side_by_side(scene, options_, known, limits_, account_, {}, inheritance_)
                 : search_alone(scene, options_, known, limits_, nullptr, inheritance_);
  outcome_.rests_on_known_bound = known_ > floor_ && outcome_.lower_bound <= known_;
  if (charges) take_traced(*charges, outcome_);
}

void Phases::enter(Phase phase) {
  const auto known = plan_ ? std::optional(cost(*plan_, options_.objective)) : std::nullopt;
  progress_.know(lower(), known);
  progress_.enter(phase);
}

void Phases::keep_cheaper(std::optional<Plan> plan) {
  const Objective objective = options_.objective;
  if (plan && (!plan_ || cost(*plan, objective) < cost(*plan_, objective))) plan_ = std::move(plan);
}

}  // namespace quadrille::continuous
