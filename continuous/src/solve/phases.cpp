// SPDX-License-Identifier: MIT
#include "solve/phases.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "feasibility/bottleneck.hpp"
#include "feasibility/feasibility.hpp"
#include "primal/chosen_ends.hpp"
#include "primal/first_plan.hpp"
#include "primal/serial_plan.hpp"
#include "quadrille/core/free_bound.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "quadrille/solve/frame.hpp"
#include "routes/route_search.hpp"
#include "solve/portfolio.hpp"
#include "solve/small_instances.hpp"

namespace quadrille::continuous {
namespace {

/// For the search among arrangements of agents, before agents that block each other are looked for
/// and after that: some hundredths of a second, about half a second.
constexpr std::int64_t kShortSearch = 5'000'000, kLongSearch = 50'000'000;

/// That the agents were searched together up to the bound.
void charge_search(Attribution& attribution, Cost bound) {
  attribution.raises.clear();
  if (bound == attribution.free_bound) return;
  Raise raise{RaiseKind::search, bound - attribution.free_bound, {}, {}};
  for (const AgentId i : IdRange<AgentId>(attribution.agents.size())) raise.agents.push_back(i);
  attribution.raises.push_back(std::move(raise));
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

bool cannot_both_end(const Instance& instance, AgentId i, AgentId j) {
  const Agent &a = instance.agent(i), &b = instance.agent(j);
  if (a.leaves || b.leaves) return false;
  const Roadmap& roadmap = instance.roadmap();
  const auto first = a.goals.vertices(), second = b.goals.vertices();
  return std::all_of(first.begin(), first.end(), [&](VertexId g) {
    return std::all_of(second.begin(), second.end(), [&](VertexId h) {
      return geometry::bodies_overlap(a.body_as(roadmap.shape(g)), roadmap.place(g),
                                      b.body_as(roadmap.shape(h)), roadmap.place(h));
    });
  });
}

}  // namespace

solve::Infeasibility infeasibility(const Instance& instance, const std::vector<AgentId>& blocked) {
  if (blocked.size() == 1)
    return {"agent " + std::to_string(blocked.front().index()) +
                " cannot get past the moving obstacles" +
                (instance.agent(blocked.front()).deadline ? " by its deadline" : "") +
                ", even without other agents",
            blocked,
            {}};
  if (blocked.size() == 2 && cannot_both_end(instance, blocked[0], blocked[1]))
    return {"agents " + std::to_string(blocked[0].index()) + " and " +
                std::to_string(blocked[1].index()) +
                " cannot both be at a goal: their bodies overlap at every two of their goals",
            blocked,
            {}};
  const bool are_all = blocked.size() == instance.num_agents();
  std::string text = are_all && blocked.size() > 2 ? "the agents" : "agents";
  if (!are_all || blocked.size() == 2)
    for (const AgentId i : blocked)
      text += (i == blocked.front() ? " " : " and ") + std::to_string(i.index());
  text += blocked.size() == 2 ? " cannot both" : " cannot all";
  text += " reach their goals";
  if (!are_all) text += ", even without the others";
  std::vector<VertexId> bottleneck = find_bottleneck(instance, blocked);
  const std::string where = describe_bottleneck(instance, blocked, bottleneck);
  return {where.empty() ? text : text + ": " + where, blocked, std::move(bottleneck)};
}

void Phases::run() {
  desk_.pulse.enter(Phase::set_up);
  Scene scene(instance_, desk_.limits, warm_.store, options_.settings);
  scene.set_fees(fees_);
  if (!scene.is_complete() || are_kept_off(scene)) return;
  const auto free_cost = [&](AgentId i) { return scene.free_cost(i); };
  const auto agents = instance_.agent_ids();
  if (options_.explain)
    known_.attribution = solve::free_charges(agents, options_.objective, free_cost);
  if (learn(scene, free_bound(agents, options_.objective, free_cost), std::nullopt, "")) return;
  if (take_warm_start(scene)) return;
  const auto groups = options_.joint_work > 0 ? small_groups(scene) : std::vector<JointGroup>();
  const bool is_joint_first = !groups.empty();
  if (is_joint_first && search_jointly(scene, groups)) return;
  // Routes lead to one goal, and who follows them waits anywhere.
  const bool has_routes = options_.system == System::dpll && !instance_.has_goal_sets() &&
                          instance_.roadmap().no_waiting().empty();
  if (has_routes && options_.route_work > 0 && instance_.num_agents() <= kMaxRouteAgents &&
      look_at_routes(scene))
    return;
  if (!find_some_plan(scene, is_joint_first))
    search_side_by_side(scene, options_, account_, desk_, kUsualPace, warm_, proof_);
}

bool Phases::are_kept_off(const Scene& scene) {
  for (const AgentId i : instance_.agent_ids()) {
    if (scene.free_cost(i) < kAnyCost) continue;
    known_.infeasible = infeasibility(instance_, {i});
    return true;
  }
  return false;
}

bool Phases::take_warm_start(Scene& scene) {
  IdVector<AgentId, Cost> free_costs(instance_.num_agents());
  for (const AgentId i : instance_.agent_ids()) free_costs[i] = scene.free_cost(i);
  const Cost bound = solve::bound_of_all(warm_.bounds, free_costs, options_.objective);
  if (!warm_.bounds.empty() && learn(scene, unless_proof(bound), std::nullopt, "")) return true;
  for (const auto& draft : warm_.drafts) {
    desk_.pulse.enter(Phase::first_plan);
    if (learn(scene, known_.floor, complete_plan(scene, draft), "mended")) return true;
  }
  return false;
}

bool Phases::search_jointly(Scene& scene, const std::vector<JointGroup>& groups) {
  desk_.pulse.enter(Phase::joint_search);
  SmallReport report = search_small_groups(scene, groups, options_.objective, options_.joint_work);
  return is_blocked(report.blocked) ||
         learn(scene, unless_proof(report.lower_bound), std::move(report.plan), "joint");
}

bool Phases::look_at_routes(Scene& scene) {
  desk_.pulse.enter(Phase::routes);
  auto routes = search_routes(scene, options_.objective, options_.route_work);
  return learn(scene, unless_proof(routes.lower_bound), std::move(routes.plan), "routes");
}

bool Phases::find_some_plan(Scene& scene, bool was_joint) {
  if (!known_.plan || was_joint) {
    desk_.pulse.enter(Phase::first_plan);
    keep_cheaper(scene, find_first_plan(scene), "prioritised");
  }
  // Moves one after the other have pauses between.
  const bool may_pause = instance_.roadmap().no_waiting().empty();
  if (!known_.plan && may_pause) with_one_goal_each(scene, &Phases::move_one_by_one);
  if (!known_.plan && !was_joint) {
    desk_.pulse.enter(Phase::feasibility);
    Feasibility feasibility = check_feasibility(scene);
    if (is_blocked(feasibility.blocked)) return true;
    keep_cheaper(scene, std::move(feasibility.plan), "joint");
    if (!known_.plan && may_pause) with_one_goal_each(scene, &Phases::search_longer);
  }
  return false;
}

void Phases::with_one_goal_each(Scene& scene, void (Phases::*search)(Scene&)) {
  if (!instance_.has_goal_sets()) return (this->*search)(scene);
  std::optional<Instance> chosen;
  try {
    chosen = with_chosen_ends(scene);
  } catch (const LimitReached&) {
  }
  if (!chosen) return;
  Scene with_ends(*chosen, desk_.limits, nullptr, options_.settings);
  with_ends.set_fees(fees_);
  if (with_ends.is_complete()) (this->*search)(with_ends);
}

void Phases::search_longer(Scene& scene) {
  keep_cheaper(scene, search_serial_plan(scene, kLongSearch), "serial-search");
}

/// The settled one is dear where it can be had, and the search finds a cheaper one soon or not at
/// all.
void Phases::move_one_by_one(Scene& scene) {
  keep_cheaper(scene, search_serial_plan(scene, kShortSearch), "serial-search");
  if (!known_.plan) keep_cheaper(scene, settle_agents(scene), "settling");
}

bool Phases::is_blocked(const std::vector<AgentId>& blocked) {
  if (!blocked.empty()) known_.infeasible = infeasibility(instance_, blocked);
  return !blocked.empty();
}

bool Phases::learn(const Scene& scene, Cost bound, std::optional<Plan> plan, const char* source) {
  known_.prove(bound);
  if (known_.attribution) charge_search(*known_.attribution, known_.floor);
  keep_cheaper(scene, std::move(plan), source);
  if (known_.floor > most_cost(instance_, options_.objective)) {
    known_.infeasible = solve::Infeasibility{"no plan keeps all deadlines"};
    return true;
  }
  return known_.cost && *known_.cost <= known_.lower();
}

void Phases::keep_cheaper(const Scene& scene, std::optional<Plan> plan, const char* source) {
  if (!plan) return;
  const Cost its_cost = scene.cost(*plan, options_.objective);
  known_.offer(std::make_shared<const Plan>(*std::move(plan)), its_cost);
  known_.credit(source);
}

}  // namespace quadrille::continuous
