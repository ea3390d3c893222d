// SPDX-License-Identifier: MIT
#include "primal/plan_improver.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/continuous/verify.hpp"

namespace quadrille::continuous {

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

// After long work, where little of the cost is left above the free costs, a proof is near, and
// where many agents have far to go, something is gained all the time. Where more is left, plans
// close the gap faster than cores do.
bool PlanImprover::pays() const {
  constexpr Cost kSmallPart = 200, kGainedPart = 10;
  const Settings& settings = scene_.settings();
  return !is_done() && effort() < Effort::microseconds(settings.improve_patience) + last_gain_ &&
         (effort() < Effort::microseconds(settings.improve_long_work) ||
          excess() > cost_ / kSmallPart || turn_gain_ >= excess() / kGainedPart);
}

bool PlanImprover::improve(Effort more_effort) {
  const Effort enough = effort() + more_effort;
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
  const auto most = static_cast<std::size_t>(scene_.settings().improve_agents);
  const std::size_t size = std::min<std::size_t>(2 + draw(most - 1), instance.num_agents());
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
    num_compared_ += static_cast<std::int64_t>(steps.size() + agents_[j].steps.size());
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
