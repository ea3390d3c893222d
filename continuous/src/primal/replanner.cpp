// SPDX-License-Identifier: MIT
#include "quadrille/continuous/replanner.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "model/since_now.hpp"
#include "primal/plan_improver.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "traffic/scene.hpp"
#include "traffic/scene_store.hpp"
#include "traffic/steps.hpp"
#include "traffic/traffic.hpp"

namespace quadrille::continuous {
namespace {

/// Where agents that give way may go: so many vertices near where they are.
constexpr std::size_t kPlacesAside = 64;
/// So many agents give way at a time, and in so many orders their paths are looked for.
constexpr std::size_t kMostPushed = 8;
constexpr int kOrders = 4;
/// As PlanImprover::effort.
constexpr Effort kStep = Effort::nanoseconds(25);

/// The vertices that the agent reaches with the fewest moves, its start among them, and where it
/// may stay.
Goals places_near(const Instance& instance, AgentId i) {
  const ClassId c = instance.class_of(i);
  std::vector<VertexId> places{instance.agent(i).start};
  for (std::size_t k = 0; k < places.size() && places.size() < kPlacesAside; ++k)
    for (const EdgeId e : instance.out_edges(c, places[k])) {
      const VertexId to = instance.roadmap().to(e);
      if (std::find(places.begin(), places.end(), to) == places.end()) places.push_back(to);
    }
  // A place in the middle of a move is left, and no goal.
  if (instance.roadmap().lane_place(places.front()) != nullptr && places.size() > 1)
    places.erase(places.begin());
  if (!instance.agent(i).leaves)
    std::erase_if(places, [&](VertexId v) { return !instance.roadmap().may_wait(v); });
  if (places.empty()) places.push_back(instance.agent(i).start);
  return Goals(std::move(places));
}

}  // namespace

/// One instance, from 0 on.
class Replanner::Round {
 public:
  Round(const Instance& instance, const Plan& plan, const Limits& limits, SceneStore& store)
      : now_(instance.now()),
        instance_(since_now(instance)),
        monitor_(limits),
        store_(store),
        given_(plan),
        states_(instance.num_agents()) {
    store.adopt(instance_);
    scene_.emplace(instance_, monitor_, &store);
    finder_.emplace(instance_, &monitor_);
    traffic_ = Traffic::make(*scene_);
    Plan since = plan;
    shift(since, -now_);
    for (const AgentId i : instance_.agent_ids()) {
      State& state = states_[i];
      state.path = without_stops(instance_, i, since.paths[i]);
      state.end = since.paths[i].back().vertex;
      put(i);
    }
  }

  bool send(AgentId agent, const MayPush& may_push) {
    if (is_over_) return false;
    const auto before = states_;
    try {
      if (send_alone(agent)) return true;
      return may_push && send_pushing(agent, may_push);
    } catch (const LimitReached&) {
      // The traffic is what it is now, and of no use any more.
      states_ = before;
      is_over_ = true;
      return false;
    }
  }

  bool improve(Effort effort) {
    if (is_over_) return false;
    try {
      return improve_ends(effort);
    } catch (const LimitReached&) {
      is_over_ = true;
      return true;  // perhaps
    }
  }

  [[nodiscard]] Plan plan() const {
    Plan plan;
    for (const AgentId i : instance_.agent_ids()) {
      if (states_[i].is_given) {
        plan.paths.push_back(given_.paths[i]);
        continue;
      }
      Plan one;
      one.paths.push_back(with_stops(instance_, i, states_[i].path));
      shift(one, now_);
      plan.paths.push_back(one.paths[AgentId(0)]);
    }
    return plan;
  }
  [[nodiscard]] bool arrives(AgentId i) const {
    return instance_.agent(i).goals.contains(states_[i].end);
  }
  [[nodiscard]] Effort effort() const {
    return spent_ +
           (num_compared_ + traffic_->effort() + finder_->effort() + aside_effort_) * kStep;
  }
  [[nodiscard]] Cost free_cost(AgentId i) const { return scene_->free_cost(i); }

 private:
  struct State {
    TimedPath path;
    VertexId end;
    bool is_given = true;
    bool is_in = false;
    Traffic::Handle place = 0;
    std::vector<Step> steps;
  };

  /// Throws LimitReached; then all paths are what they should be, and some are not in the traffic.
  bool improve_ends(Effort effort) {
    std::vector<Agent> agents(instance_.agents().begin(), instance_.agents().end());
    for (const AgentId i : instance_.agent_ids()) {
      agents[i.index()].goals = Goals{states_[i].end};
      agents[i.index()].deadline.reset();
    }
    const auto instance = instance_.with_agents(std::move(agents));
    if (!instance) return false;
    Plan plan;
    for (const AgentId i : instance_.agent_ids())
      plan.paths.push_back(with_stops(*instance, i, states_[i].path));
    store_.adopt(*instance);
    Scene scene(*instance, monitor_, &store_);
    PlanImprover improver(scene, std::move(plan));
    const bool is_better = improver.improve(effort);
    spent_ += improver.effort();
    if (!is_better) return false;
    std::vector<AgentId> changed;
    for (const AgentId i : instance_.agent_ids()) {
      TimedPath path = without_stops(*instance, i, improver.plan().paths[i]);
      if (path == states_[i].path) continue;
      take_out(i);
      states_[i].path = std::move(path);
      states_[i].is_given = false;
      changed.push_back(i);
    }
    for (const AgentId i : changed) put(i);
    return true;
  }

  void put(AgentId i) {
    State& state = states_[i];
    list_steps(instance_, i, state.path, state.steps);
    state.place = traffic_->put(instance_.class_of(i), state.steps);
    state.is_in = true;
  }
  void take_out(AgentId i) {
    if (states_[i].is_in) traffic_->take_out(states_[i].place);
    states_[i].is_in = false;
  }
  void put_back(const IdVector<AgentId, State>& before) {
    for (const AgentId i : instance_.agent_ids()) {
      if (states_[i].is_in && states_[i].path == before[i].path) continue;
      take_out(i);
      states_[i].path = before[i].path;
      states_[i].end = before[i].end;
      states_[i].is_given = before[i].is_given;
      put(i);
    }
  }
  void set(AgentId i, TimedPath path) {
    State& state = states_[i];
    state.end = path.moves.empty() ? instance_.agent(i).start
                                   : instance_.roadmap().edge(path.moves.back().edge).to;
    state.path = std::move(path);
    state.is_given = false;
    put(i);
  }

  bool send_alone(AgentId i) {
    take_out(i);
    TimedPath path;
    if (finder_->find(scene_->task(i), traffic_->bans(instance_.class_of(i)),
                      arrival_bound(instance_, i), &path)) {
      set(i, std::move(path));
      return true;
    }
    put(i);
    return false;
  }

  /// Among those that are in the traffic. It is not.
  bool find_aside(AgentId i, TimedPath& path) {
    std::vector<Agent> agents(instance_.agents().begin(), instance_.agents().end());
    Agent& agent = agents[i.index()];
    agent.goals = places_near(instance_, i);
    agent.deadline.reset();
    const auto aside = instance_.with_agents(std::move(agents));
    if (!aside) return false;
    const GoalDistances distances(*aside, i);
    Detours detours(*aside, i, distances);
    PathFinder finder(*aside, &monitor_);
    const bool found =
        finder.find({i, distances, detours}, traffic_->bans(instance_.class_of(i)), kForever, &path)
            .has_value();
    aside_effort_ += finder.effort();
    return found;
  }

  /// Who is where the agent would be if it were alone, in their order.
  std::vector<AgentId> find_in_the_way(AgentId i) {
    BanTable bans(instance_.roadmap());
    bans.clear(scene_->standing_bans(i));
    TimedPath path;
    std::vector<AgentId> found;
    if (!finder_->find(scene_->task(i), bans, kForever, &path)) return found;
    std::vector<Step> steps;
    list_steps(instance_, i, path, steps);
    for (const AgentId j : instance_.agent_ids()) {
      if (j == i) continue;
      num_compared_ += static_cast<std::int64_t>(steps.size() + states_[j].steps.size());
      if (first_encounter(*scene_, i, steps, j, states_[j].steps)) found.push_back(j);
    }
    return found;
  }

  bool send_pushing(AgentId agent, const MayPush& may_push) {
    std::vector<AgentId> order{agent};
    for (const AgentId j : find_in_the_way(agent))
      if (order.size() <= kMostPushed && may_push(j)) order.push_back(j);
    if (order.size() == 1) return false;
    IdVector<AgentId, bool> has_goal(instance_.num_agents(), false);
    for (const AgentId j : order) has_goal[j] = j == agent || arrives(j);
    const auto before = states_;
    for (int tries = 0; tries < kOrders; ++tries) {
      for (const AgentId j : order) take_out(j);
      std::size_t k = 0;
      while (k < order.size() && find_in_turn(order[k], order[k] == agent, has_goal[order[k]])) ++k;
      if (k == order.size()) return true;
      put_back(before);
      if (k == 0) return false;
      // Who found no path comes first.
      std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(k),
                  order.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    }
    return false;
  }

  bool find_in_turn(AgentId i, bool has_to_arrive, bool has_goal) {
    TimedPath path;
    const bool is_home =
        has_goal && finder_->find(scene_->task(i), traffic_->bans(instance_.class_of(i)),
                                  arrival_bound(instance_, i), &path);
    if (!is_home && (has_to_arrive || !find_aside(i, path))) return false;
    set(i, std::move(path));
    return true;
  }

  const Ticks now_;
  const Instance instance_;
  LimitMonitor monitor_;
  SceneStore& store_;
  const Plan given_;
  std::optional<Scene> scene_;
  std::optional<PathFinder> finder_;
  std::unique_ptr<Traffic> traffic_;
  IdVector<AgentId, State> states_;
  bool is_over_ = false;  // limits are met
  Effort spent_;
  std::int64_t num_compared_ = 0, aside_effort_ = 0;
};

class Replanner::Parts {
 public:
  explicit Parts(std::shared_ptr<const Roadmap> base) : store(std::move(base)) {}
  SceneStore store;
  std::unique_ptr<Round> round;  // null: the limits were met before anything could be done
  std::optional<Instance> instance;
  Plan given;
};

Replanner::Replanner(std::shared_ptr<const Roadmap> base) {
  QUADRILLE_REQUIRE(base != nullptr, "a replanner has a roadmap");
  parts_ = std::make_unique<Parts>(std::move(base));
}
Replanner::~Replanner() = default;
Replanner::Replanner(Replanner&&) noexcept = default;
Replanner& Replanner::operator=(Replanner&&) noexcept = default;

void Replanner::begin(const Instance& instance, const Plan& plan, const Limits& limits) {
  QUADRILLE_REQUIRE(instance.obstacles().empty(), "obstacles wait for nobody");
  QUADRILLE_REQUIRE(plan.paths.size() == instance.num_agents(), "a path for each agent");
  parts_->round.reset();
  parts_->instance = instance;
  parts_->given = plan;
  try {
    parts_->round = std::make_unique<Round>(instance, plan, limits, parts_->store);
  } catch (const LimitReached&) {
  }
}
bool Replanner::send(AgentId agent, const MayPush& may_push) {
  return parts_->round && parts_->round->send(agent, may_push);
}
bool Replanner::improve(Effort effort) { return parts_->round && parts_->round->improve(effort); }
Plan Replanner::plan() const { return parts_->round ? parts_->round->plan() : parts_->given; }
bool Replanner::arrives(AgentId agent) const {
  if (parts_->round) return parts_->round->arrives(agent);
  return parts_->instance->agent(agent).goals.contains(parts_->given.paths[agent].back().vertex);
}
Effort Replanner::effort() const { return parts_->round ? parts_->round->effort() : Effort(); }
Cost Replanner::free_cost(AgentId agent) const {
  if (parts_->round) return parts_->round->free_cost(agent);
  return as_cost(continuous::free_cost(*parts_->instance, agent).value());
}

}  // namespace quadrille::continuous
