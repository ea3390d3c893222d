// SPDX-License-Identifier: MIT
#include "primal/plan_improver.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous {
namespace {

/// Agents in one neighbourhood, at most. Measured on 25 hard rows with three seeds each, what plans
/// cost too much at the end, with up to 8 and 16 agents: sparse 1.1 and 0.3 %, empty16 0.28 and
/// 0.25 %, room64 0.16 and 0.13 %.
constexpr std::size_t kMaxChosen = 16;
/// Steps without gain after which it pays no more: kLeastPatience, and kPatience for each step up
/// to the last gain. Measured: 4,000,000 instead of 2,000,000 changes little; two for each step
/// take two to four times as long, and the plans of sparse, empty16 and room64 cost 0.30, 0.25 and
/// 0.13 % too much instead of 0.59, 0.48 and 0.14 %, but proofs are no faster with them.
constexpr std::int64_t kLeastPatience = 2'000'000, kPatience = 1;
/// After kLongWork steps, and where at most 1 / kSmallPart of the cost is left above the free
/// costs, a turn pays if it gains 1 / kGainedPart of what is left. A proof is near then, and where
/// many agents have far to go, something is gained all the time: on the warehouse (k = 3) the last
/// 0.04 % of the plans of 135 and 155 agents took 20 s; with this rule the whole solves take 4 and
/// 10 s (with a quarter to gain 4 and 11, with a twentieth 5 and 10). Where more is left, plans
/// close the gap faster than cores do.
constexpr std::int64_t kLongWork = 8'000'000;
constexpr Cost kSmallPart = 200, kGainedPart = 10;

}  // namespace

PlanImprover::PlanImprover(Scene& scene, Plan plan)
    : scene_(scene),
      plan_(std::move(plan)),
      cost_(continuous::cost(plan_, Objective::sum_of_costs)),
      finder_(scene.instance(), &scene.limits()),
      traffic_(Traffic::make(scene)),
      free_steps_(scene.instance().num_agents()),
      agents_(scene.instance().num_agents()) {}

Cost PlanImprover::excess() const {
  Cost excess = cost_;
  for (const AgentId i : scene_.instance().agent_ids()) excess -= scene_.free_cost(i);
  return excess;
}

bool PlanImprover::is_done() const { return scene_.instance().num_agents() < 2 || excess() <= 0; }

void PlanImprover::restart_from(Plan plan) {
  plan_ = std::move(plan);
  cost_ = continuous::cost(plan_, Objective::sum_of_costs);
  is_loaded_ = false;
}

bool PlanImprover::pays() const {
  return !is_done() && effort() < kLeastPatience + kPatience * last_gain_ &&
         (effort() < kLongWork || excess() > cost_ / kSmallPart ||
          turn_gain_ >= excess() / kGainedPart);
}

bool PlanImprover::improve(std::int64_t more_effort) {
  const std::int64_t enough = effort() + more_effort;
  turn_gain_ = 0;
  if (is_done()) return false;
  const Instance& instance = scene_.instance();
  try {
    if (!is_loaded_) load_paths();
    while (effort() < enough && !scene_.limits().exhausted())
      if (replan(choose())) last_gain_ = effort();
  } catch (const LimitReached&) {  // the paths are those before the last neighbourhood
    if (!is_loaded_) return false;
  }
  Plan improved;
  for (const AgentId i : instance.agent_ids())
    improved.paths.push_back(with_stops(instance, i, agents_[i].path));
  const Cost cost = continuous::cost(improved, Objective::sum_of_costs);
  if (cost >= cost_) return false;
  if (!verify(instance, improved).valid()) {
    is_loaded_ = false;
    return false;
  }
  plan_ = std::move(improved);
  turn_gain_ = cost_ - cost;
  cost_ = cost;
  return true;
}

/// Those of the plan. Agents that have theirs already stay in the traffic.
void PlanImprover::load_paths() {
  const Instance& instance = scene_.instance();
  for (const AgentId i : instance.agent_ids()) {
    TimedPath path = without_stops(instance, i, plan_.paths[i]);
    AgentState& agent = agents_[i];
    if (agent.is_under_way && path == agent.path) continue;
    take_out(agent);
    agent.path = std::move(path);
    put(i, agent);
  }
  is_loaded_ = true;
  last_gain_ = effort();
}

void PlanImprover::put(AgentId i, AgentState& agent) {
  list_steps(scene_.instance(), i, agent.path, agent.steps);
  agent.place = traffic_->put(scene_.instance().class_of(i), agent.steps);
  agent.is_under_way = true;
}

void PlanImprover::take_out(AgentState& agent) {
  if (agent.is_under_way) traffic_->take_out(agent.place);
  agent.is_under_way = false;
}

AgentId PlanImprover::choose_delayed() {
  Cost delays = 0;
  for (const AgentId i : scene_.instance().agent_ids()) delays += delay(i);
  if (delays > 0) {
    auto at = static_cast<Cost>(random_.below(static_cast<std::uint64_t>(delays)));
    for (const AgentId i : scene_.instance().agent_ids()) {
      at -= delay(i);
      if (at < 0) return i;
    }
  }
  return AgentId(draw(agents_.size()));
}

/// Somebody who is late, the likelier the later, some of those who are in its way, and some others.
std::vector<AgentId> PlanImprover::choose() {
  const Instance& instance = scene_.instance();
  const std::size_t size = std::min<std::size_t>(2 + draw(kMaxChosen - 1), instance.num_agents());
  std::vector<AgentId> chosen{choose_delayed()};
  const AgentId late = chosen.front();
  std::vector<Step>& steps = free_steps_[late];
  if (steps.empty()) {
    BanTable bans(instance.roadmap());
    bans.clear(scene_.standing_bans(late));
    TimedPath path;
    static_cast<void>(finder_.find(scene_.task(late), bans, kForever, &path));
    list_steps(instance, late, path, steps);
  }
  std::vector<AgentId> others, in_way;
  for (const AgentId j : instance.agent_ids()) {
    if (j == late) continue;
    others.push_back(j);
    effort_ += static_cast<std::int64_t>(steps.size() + agents_[j].steps.size());
    if (first_encounter(scene_, late, steps, j, agents_[j].steps)) in_way.push_back(j);
  }
  for (std::vector<AgentId>* group : {&in_way, &others})
    while (chosen.size() < size && !group->empty()) {
      const std::size_t at = draw(group->size());
      const AgentId j = (*group)[at];
      group->erase(group->begin() + static_cast<std::ptrdiff_t>(at));
      if (std::find(chosen.begin(), chosen.end(), j) == chosen.end()) chosen.push_back(j);
    }
  for (std::size_t k = chosen.size(); k > 1; --k) std::swap(chosen[k - 1], chosen[draw(k)]);
  return chosen;
}

bool PlanImprover::replan(const std::vector<AgentId>& chosen) {
  const Instance& instance = scene_.instance();
  Cost left = 0;  // what may be spent above the free costs
  for (const AgentId i : chosen) {
    left += delay(i);
    traffic_->show(agents_[i].place, false);
  }
  std::vector<AgentState> fresh;
  try {
    for (const AgentId i : chosen) {
      AgentState state;
      const Ticks bound = as_ticks(scene_.free_cost(i) + left + 1);
      BanTable& bans = traffic_->bans(instance.class_of(i));
      if (!finder_.find(scene_.task(i), bans, bound, &state.path)) break;
      left -= as_cost(state.path.arrival) - scene_.free_cost(i);
      put(i, state);
      fresh.push_back(std::move(state));
    }
  } catch (const LimitReached&) {
    for (const AgentId i : chosen) traffic_->show(agents_[i].place, true);
    for (AgentState& state : fresh) take_out(state);
    throw;
  }
  const bool is_done = fresh.size() == chosen.size();
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    AgentState& agent = agents_[chosen[k]];
    if (is_done) {
      take_out(agent);
      agent = std::move(fresh[k]);
    } else {
      traffic_->show(agent.place, true);
    }
  }
  if (!is_done)
    for (AgentState& state : fresh) take_out(state);
  return is_done && left > 0;
}

}  // namespace quadrille::continuous
