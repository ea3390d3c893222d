// SPDX-License-Identifier: MIT
#include "support/ruled_search.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace quadrille::discrete::support {
namespace {

constexpr int kGone = -1;

/// What the rules say, timestep by timestep, in times that count from the beginning.
class Book {
 public:
  explicit Book(const Instance& instance) : instance_(instance) {
    for (const Agent& agent : instance.agents()) {
      last_ = std::max(last_, since(agent.release));
      if (agent.deadline) last_ = std::max(last_, since(*agent.deadline));
    }
    for (const Blockage& b : instance.rules().blockages)
      last_ = std::max({last_, since(b.first), b.last ? since(*b.last) : 0});
  }
  /// From the one after this on all timesteps are alike.
  [[nodiscard]] int last() const { return last_ + 1; }

  [[nodiscard]] bool may_be(int v, int t) const {
    return std::none_of(instance_.rules().blockages.begin(), instance_.rules().blockages.end(),
                        [&](const Blockage& b) {
                          return !b.to && static_cast<int>(b.vertex.value()) == v && holds(b, t);
                        });
  }
  [[nodiscard]] bool may_go(std::size_t agent, int v, int w, int t) const {
    if (v == w) return true;
    if (t < since(instance_.agents()[AgentId(agent)].release)) return false;
    const VertexId from(static_cast<std::size_t>(v)), to(static_cast<std::size_t>(w));
    const auto near = instance_.graph().neighbours(from);
    return std::find(near.begin(), near.end(), to) != near.end() &&
           std::none_of(
               instance_.rules().blockages.begin(), instance_.rules().blockages.end(),
               [&](const Blockage& b) {
                 return b.to && holds(b, t) &&
                        ((b.vertex == from && *b.to == to) || (b.vertex == to && *b.to == from));
               });
  }
  [[nodiscard]] bool is_late(std::size_t agent, int t) const {
    const auto& deadline = instance_.agents()[AgentId(agent)].deadline;
    return deadline && t > since(*deadline);
  }
  /// How many waypoints are visited by somebody who comes to `v`.
  [[nodiscard]] int visit(std::size_t agent, int stage, int v) const {
    const auto& points = instance_.agents()[AgentId(agent)].waypoints;
    while (static_cast<std::size_t>(stage) < points.size() &&
           static_cast<int>(points[static_cast<std::size_t>(stage)].value()) == v)
      ++stage;
    return stage;
  }
  [[nodiscard]] bool turns() const { return instance_.rules().turn > 0; }
  /// Where somebody faces at its start: 0 east, 1 south, 2 west, 3 north.
  [[nodiscard]] int faces_at_first(std::size_t agent) const {
    return static_cast<int>(instance_.agents()[AgentId(agent)].heading);
  }
  [[nodiscard]] int of_a_turn() const { return instance_.rules().turn; }
  /// Of two neighbouring cells the second is where somebody comes who goes ahead.
  [[nodiscard]] bool is_ahead(int facing, int v, int w) const {
    const GridLayout& cells = *instance_.graph().layout();
    const Cell from = cells.cell_of(VertexId(static_cast<std::size_t>(v)));
    const Cell to = cells.cell_of(VertexId(static_cast<std::size_t>(w)));
    constexpr int kRight[] = {1, 0, -1, 0}, kDown[] = {0, 1, 0, -1};
    return to.x - from.x == kRight[facing] && to.y - from.y == kDown[facing];
  }
  [[nodiscard]] bool may_end(std::size_t agent, int stage, int v) const {
    const Agent& task = instance_.agents()[AgentId(agent)];
    return static_cast<std::size_t>(stage) == task.waypoints.size() &&
           task.goals.contains(VertexId(static_cast<std::size_t>(v)));
  }

 private:
  [[nodiscard]] int since(Timestep t) const { return std::max(-1, t - instance_.now()); }
  [[nodiscard]] bool holds(const Blockage& b, int t) const {
    const Timestep time = instance_.now() + t;
    return b.first <= time && (!b.last || time <= *b.last);
  }
  const Instance& instance_;
  int last_ = 0;
};

struct State {
  std::vector<int> at, stage, done;
  std::vector<int> facing, turning;      // where turns take time: timesteps of the turn to come
  std::vector<std::vector<int>> before;  // the last timesteps, the latest first
  int time = 0;
  friend auto operator<=>(const State&, const State&) = default;
};

class RuledSearch {
 public:
  /// What counts is `of_step` times the cost, and `of_move` times the moves.
  RuledSearch(const Instance& instance, Objective objective, Cost of_step = 1, Cost of_move = 0)
      : instance_(instance),
        book_(instance),
        of_step_(of_step),
        of_move_(of_move),
        is_sum_(objective == Objective::sum_of_costs),
        num_agents_(instance.num_agents()),
        robust_(static_cast<std::size_t>(instance.rules().robust)) {}

  JointAnswer run(std::size_t max_states) {
    State start;
    for (std::size_t i = 0; i < num_agents_; ++i) {
      start.at.push_back(static_cast<int>(instance_.agents()[AgentId(i)].start.value()));
      start.stage.push_back(book_.visit(i, 0, start.at.back()));
      start.done.push_back(0);
      if (book_.turns()) {
        start.facing.push_back(book_.faces_at_first(i));
        start.turning.push_back(0);
      }
      if (!book_.may_be(start.at.back(), 0)) return {Status::infeasible, 0, {}};
    }
    reach(start, 0, {});
    while (!open_.empty()) {
      if (nodes_.size() > max_states) return {};
      const auto [cost, node] = *open_.begin();
      open_.erase(open_.begin());
      if (is_closed_[node]) continue;
      is_closed_[node] = true;
      const State state = *nodes_[node].state;
      if (std::find(state.done.begin(), state.done.end(), 0) == state.done.end())
        if (stays_allowed(state)) return {Status::optimal, cost, plan_to(node)};
      expand(state, cost, node);
    }
    return {Status::infeasible, 0, {}};
  }

 private:
  struct Node {
    const State* state;
    std::optional<std::size_t> parent;
  };

  /// All are done; those who stay must not be in anybody's way later on.
  bool stays_allowed(const State& state) const {
    for (std::size_t i = 0; i < num_agents_; ++i)
      for (int t = state.time; state.at[i] != kGone && !leaves(i) && t <= book_.last() + 1; ++t)
        if (!book_.may_be(state.at[i], t)) return false;
    return true;
  }
  bool leaves(std::size_t i) const { return instance_.agents()[AgentId(i)].leaves; }

  void reach(const State& state, Cost cost, std::optional<std::size_t> parent) {
    const auto [it, is_new] = index_.try_emplace(state, nodes_.size());
    if (is_new) {
      nodes_.push_back({&it->first, parent});
      costs_.push_back(cost);
      is_closed_.push_back(false);
    } else if (cost >= costs_[it->second]) {
      return;
    } else {
      costs_[it->second] = cost;
      nodes_[it->second].parent = parent;
    }
    open_.emplace(cost, it->second);
  }

  void expand(const State& state, Cost cost, std::size_t node) {
    Cost price = 0;
    for (std::size_t i = 0; i < num_agents_; ++i) {
      if (state.done[i] != 0) continue;
      price = is_sum_ ? price + 1 : 1;
      if (!book_.may_end(i, state.stage[i], state.at[i])) continue;
      State done = state;
      done.done[i] = 1;
      reach(done, cost, node);
    }
    State next = state;
    next.time = std::min(state.time + 1, book_.last());
    if (robust_ > 0) {
      next.before.insert(next.before.begin(), state.at);
      if (next.before.size() > robust_) next.before.resize(robust_);
    }
    move(state, next, 0, cost + of_step_ * price, node);
  }

  void move(const State& state, State& next, std::size_t i, Cost cost, std::size_t node) {
    if (i == num_agents_) return reach(next, cost, node);
    if (state.done[i] != 0 && (leaves(i) || state.at[i] == kGone)) {
      next.at[i] = kGone;
      return move(state, next, i + 1, cost, node);
    }
    const int v = state.at[i];
    const bool is_turning = book_.turns() && state.turning[i] > 0;
    if (book_.turns()) {
      next.facing[i] = state.facing[i];
      next.turning[i] = std::max(0, state.turning[i] - 1);
    }
    go(state, next, i, v, cost, node);
    if (state.done[i] != 0 || is_turning) return;
    for (const VertexId w : instance_.graph().neighbours(VertexId(static_cast<std::size_t>(v))))
      if (!book_.turns() || book_.is_ahead(state.facing[i], v, static_cast<int>(w.value())))
        go(state, next, i, static_cast<int>(w.value()), cost, node);
    for (const int quarters : {1, 3}) {
      if (!book_.turns()) break;
      next.facing[i] = (state.facing[i] + quarters) % 4;
      next.turning[i] = book_.of_a_turn() - 1;
      go(state, next, i, v, cost, node);
    }
  }

  /// Agent i is at `w` next.
  void go(const State& state, State& next, std::size_t i, int w, Cost cost, std::size_t node) {
    const int v = state.at[i];
    if (!book_.may_go(i, v, w, state.time) || !book_.may_be(w, state.time + 1)) return;
    if (state.done[i] == 0 && book_.is_late(i, state.time + 1)) return;
    if (!is_free(state, next, i, w)) return;
    const State before = book_.turns() ? next : State();
    next.at[i] = w;
    next.stage[i] = state.done[i] != 0 ? state.stage[i] : book_.visit(i, state.stage[i], w);
    move(state, next, i + 1, w == v ? cost : cost + of_move_, node);
    // Those after it leave where they face behind.
    if (book_.turns()) next = before;
  }

  bool is_free(const State& state, const State& next, std::size_t i, int w) const {
    for (std::size_t j = 0; j < num_agents_; ++j) {
      if (j == i) continue;
      for (const auto& before : next.before)
        if (before[j] == w) return false;
      if (j > i || next.at[j] == kGone) continue;
      if (next.at[j] == w || (next.at[j] == state.at[i] && state.at[j] == w)) return false;
    }
    return true;
  }

  Plan plan_to(std::size_t node) const {
    std::vector<const State*> states;
    for (std::optional<std::size_t> at = node; at; at = nodes_[*at].parent)
      states.push_back(nodes_[*at].state);
    std::reverse(states.begin(), states.end());
    Plan plan;
    plan.now = instance_.now();
    plan.paths.resize(num_agents_);
    for (std::size_t i = 0; i < num_agents_; ++i) {
      Path& path = plan.paths[AgentId(i)];
      const State* last = nullptr;
      for (const State* state : states) {
        // To be done takes no time.
        if (last != nullptr && last->at == state->at && last->stage == state->stage &&
            last->before == state->before && last->facing == state->facing &&
            last->turning == state->turning && last->done != state->done) {
          last = state;
          continue;
        }
        last = state;
        if (state->at[i] != kGone) path.push_back(VertexId(static_cast<std::size_t>(state->at[i])));
      }
    }
    trim(plan);
    return plan;
  }

  const Instance& instance_;
  const Book book_;
  const Cost of_step_, of_move_;
  const bool is_sum_;
  const std::size_t num_agents_, robust_;
  std::map<State, std::size_t> index_;
  std::vector<Node> nodes_;
  std::vector<Cost> costs_;
  std::vector<bool> is_closed_;
  std::set<std::pair<Cost, std::size_t>> open_;
};

/// Where the agent is at `t`; kGone.
int place(const Agent& task, const Path& path, std::size_t t) {
  const auto last = static_cast<std::size_t>(arrival(path));
  if (t <= last) return static_cast<int>(path[t].value());
  return task.leaves ? kGone : static_cast<int>(path.back().value());
}

}  // namespace

JointAnswer ruled_search(const Instance& instance, Objective objective, std::size_t max_states) {
  return RuledSearch(instance, objective).run(max_states);
}

Cheapest fewest_moves_search(const Instance& instance, Objective objective,
                             std::size_t max_states) {
  constexpr Cost kStep = 1 << 20;
  const JointAnswer answer = RuledSearch(instance, objective, kStep, 1).run(max_states);
  return {answer.status, answer.cost / kStep, answer.cost % kStep};
}

std::string replay_rules(const Instance& instance, const Plan& plan) {
  const Book book(instance);
  if (plan.paths.size() != instance.num_agents()) return "not one path per agent";
  if (plan.now != instance.now()) return "another beginning";
  std::size_t length = static_cast<std::size_t>(book.last()) + 2;
  for (const Path& path : plan.paths) length = std::max(length, path.size() + 2);
  for (std::size_t i = 0; i < instance.num_agents(); ++i) {
    const Agent& task = instance.agents()[AgentId(i)];
    const Path& path = plan.paths[AgentId(i)];
    const std::string name = "agent " + std::to_string(i);
    if (path.empty() || path.front() != task.start) return name + ": wrong start";
    int stage = 0;
    // All that it may face, and what is left of a turn.
    std::set<std::pair<int, int>> poses{{book.faces_at_first(i), 0}};
    for (std::size_t t = 0; t < length; ++t) {
      const int here = place(task, path, t), next = place(task, path, t + 1);
      const std::string when = name + " at timestep " + std::to_string(t);
      if (here == kGone) break;
      stage = book.visit(i, stage, here);
      if (!book.may_be(here, static_cast<int>(t))) return when + ": blocked";
      if (next != kGone && !book.may_go(i, here, next, static_cast<int>(t)))
        return when + ": no such move";
      if (next == kGone || !book.turns()) continue;
      std::set<std::pair<int, int>> then;
      for (const auto& [facing, left] : poses) {
        if (next == here) then.emplace(facing, std::max(0, left - 1));
        if (next != here && left == 0 && book.is_ahead(facing, here, next)) then.emplace(facing, 0);
        for (const int quarters : {1, 3})
          if (next == here && left == 0)
            then.emplace((facing + quarters) % 4, book.of_a_turn() - 1);
      }
      if (then.empty()) return when + ": it faces elsewhere";
      poses = std::move(then);
    }
    if (!book.may_end(i, stage, static_cast<int>(path.back().value()))) return name + ": end";
    if (book.is_late(i, static_cast<int>(arrival(path)))) return name + ": late";
  }
  const auto robust = static_cast<std::size_t>(instance.rules().robust);
  for (std::size_t i = 0; i < instance.num_agents(); ++i)
    for (std::size_t j = 0; j < instance.num_agents(); ++j)
      for (std::size_t t = 0; i != j && t < length; ++t) {
        const auto at = [&](std::size_t agent, std::size_t time) {
          return place(instance.agents()[AgentId(agent)], plan.paths[AgentId(agent)], time);
        };
        const int here = at(i, t);
        if (here == kGone) continue;
        for (std::size_t s = t; s <= t + robust; ++s)
          if (at(j, s) == here)
            return "agents " + std::to_string(i) + " and " + std::to_string(j) + " at timestep " +
                   std::to_string(t);
        const int next = at(i, t + 1);
        if (next != kGone && next != here && at(j, t) == next && at(j, t + 1) == here)
          return "a swap at timestep " + std::to_string(t);
      }
  return "";
}

Instance with_random_rules(Random& random, const Instance& instance, RuleKinds kinds) {
  Graph graph = instance.graph();
  const std::size_t size = graph.num_vertices();
  const auto any = [&] { return VertexId(random.below(size)); };
  if (kinds.one_way) {
    std::vector<Graph::Edge> arcs;
    const std::size_t share = random.between(10, 70);
    for (const VertexId v : IdRange<VertexId>(size))
      for (const VertexId w : graph.neighbours(v))
        if (v < w && random.percent(share))
          arcs.push_back(random.percent(50) ? Graph::Edge{v, w} : Graph::Edge{w, v});
    graph = graph.with_one_way(arcs).value();
  }
  std::vector<Agent> agents = instance.agents().items();
  for (Agent& agent : agents) {
    if (kinds.leaving && random.percent(70)) {
      agent.leaves = true;
      if (random.percent(30)) agent.goals = any();
    }
    if (kinds.times && random.percent(50)) agent.release = static_cast<Timestep>(random.below(5));
    if (kinds.times && random.percent(60))
      agent.deadline = static_cast<Timestep>(random.between(1, 12));
    if (kinds.waypoints)
      for (std::size_t k = random.below(3); k > 0; --k) agent.waypoints.push_back(any());
  }
  Rules rules;
  if (kinds.turning && graph.layout()) {
    rules.turn = static_cast<Timestep>(random.between(1, 3));
    for (Agent& agent : agents) agent.heading = kHeadings[random.below(kHeadings.size())];
  }
  if (kinds.robust) rules.robust = static_cast<Timestep>(random.between(1, 2));
  for (std::size_t k = kinds.blockages ? random.between(1, 5) : 0; k > 0; --k) {
    Blockage blockage{any(), {}, static_cast<Timestep>(random.below(7)), {}};
    const auto near = graph.neighbours(blockage.vertex);
    if (random.percent(40) && !near.empty()) blockage.to = near[random.below(near.size())];
    if (random.percent(85)) blockage.last = blockage.first + static_cast<Timestep>(random.below(6));
    rules.blockages.push_back(blockage);
  }
  auto made = Instance::make(std::move(graph), std::move(agents), 0, std::move(rules));
  return made ? std::move(made).value() : instance;
}

}  // namespace quadrille::discrete::support
