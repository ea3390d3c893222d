// SPDX-License-Identifier: MIT
#include "settle/settle.hpp"

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "model/component.hpp"
#include "quadrille/core/contract.hpp"
#include "settle/exchange.hpp"
#include "settle/full_blocks.hpp"
#include "settle/shorten.hpp"

namespace quadrille::discrete {
namespace {

using State = Settling::State;

/// Roots that are tried: from a good one all vertices are near.
constexpr Local kRoots = 16;
/// Shifts from which on loops are left out on the way.
constexpr std::size_t kManyShifts = 1'000'000;
constexpr int kRounds = 5;

/// The vertices of a component, nearest to a root first.
std::vector<Local> order_from(const LocalGraph& graph, Local root, Timestep& depth) {
  std::vector<Timestep> distance(graph.size(), kUnreachable);
  std::vector<Local> order{root};
  distance[root] = 0;
  for (std::size_t head = 0; head < order.size(); ++head)
    for (const Local w : graph.neighbours(order[head]))
      if (distance[w] == kUnreachable) {
        distance[w] = distance[order[head]] + 1;
        order.push_back(w);
      }
  depth = distance[order.back()];
  return order;
}

std::vector<Local> best_order(const LocalGraph& graph) {
  std::vector<Local> best;
  Timestep least = kUnreachable;
  const Local step = std::max<Local>(1, graph.size() / kRoots);
  for (Local root = 0; root < graph.size(); root += step) {
    Timestep depth = 0;
    std::vector<Local> order = order_from(graph, root, depth);
    if (depth >= least) continue;
    least = depth;
    best = std::move(order);
  }
  return best;
}

/// The agents of one component.
class ComponentSettling {
 public:
  ComponentSettling(const Component& component, LocalGraph graph, std::vector<Local> starts,
                    std::vector<Local> goals)
      : graph_(std::move(graph)),
        starts_(starts),
        agents_(component.agents),
        vertices_(component.vertices),
        board_(graph_.size(), std::move(starts)),
        goal_(graph_.size(), std::move(goals)),
        exchanger_(graph_, board_),
        num_free_(graph_.size() - static_cast<Local>(component.agents.size())),
        order_(best_order(graph_)),
        rank_(graph_.size()) {
    for (Local k = 0; k < order_.size(); ++k) rank_[order_[k]] = k;
    next_ = graph_.size();
  }
  ComponentSettling(const ComponentSettling&) = delete;
  ComponentSettling& operator=(const ComponentSettling&) = delete;

  /// Settles one agent, or begins or ends. Requires State::working.
  State step(LimitMonitor& limits) {
    if (num_free_ == 0) {
      if (!rearrange_full_component(graph_, goal_, board_, limits, effort_))
        return limits.exhausted() ? State::working : State::given_up;
      return finish();
    }
    if (next_ == graph_.size() && !has_begun_) gather_goals();
    if (next_ > num_free_) {
      if (!settle(order_[next_ - 1], limits)) return State::given_up;
      if (board_.agent_at(order_[next_ - 1]) == goal_.agent_at(order_[next_ - 1])) --next_;
      shorten_if_long();
      return State::working;
    }
    board_.retrace(goal_);
    return finish();
  }

  [[nodiscard]] std::int64_t effort() const { return effort_ + exchanger_.effort(); }

  /// Writes the paths of its agents.
  [[nodiscard]] bool write(Plan& plan, LimitMonitor& limits) const {
    const auto& shifts = board_.shifts();
    const std::vector<Timestep> times = earliest_times(shifts, starts_.size(), graph_.size());
    std::vector<Timestep> arrivals(starts_.size(), 0);
    for (std::size_t k = 0; k < shifts.size(); ++k) arrivals[shifts[k].agent] = times[k];
    std::size_t size = 0;
    for (const Timestep arrival : arrivals) size += static_cast<std::size_t>(arrival) + 1;
    if (!limits.has_room_for(size * sizeof(VertexId))) return false;
    for (Local agent = 0; agent < starts_.size(); ++agent) {
      Path& path = plan.paths[agents_[agent]];
      path.reserve(static_cast<std::size_t>(arrivals[agent]) + 1);
      path.assign(1, vertices_[starts_[agent]]);
    }
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      Path& path = plan.paths[agents_[shifts[k].agent]];
      path.resize(static_cast<std::size_t>(times[k]), path.back());
      path.push_back(vertices_[shifts[k].to]);
    }
    return true;
  }

 private:
  /// The free vertices of the goals' arrangement become the first ones of the order.
  void gather_goals() {
    has_begun_ = true;
    Exchanger gatherer(graph_, goal_);
    Exchanger::Marks kept(graph_.size());
    kept.clear();
    for (Local k = 0; k < num_free_; ++k) {
      const bool done = gatherer.free(order_[k], {}, &kept);
      QUADRILLE_REQUIRE(done, "there are as many free vertices");
      kept.add(order_[k]);
    }
    effort_ += gatherer.effort();
  }

  /// A shortest way of an agent to a vertex among those that are not settled.
  [[nodiscard]] std::vector<Local> way_to(Local from, Local to) {
    std::vector<Local> queue{to};
    std::vector<Local> next(graph_.size(), kNoLocal);
    next[to] = to;
    for (std::size_t head = 0; next[from] == kNoLocal; ++head) {
      QUADRILLE_REQUIRE(head < queue.size(), "what is nearer to the root is connected");
      ++effort_;
      for (const Local w : graph_.neighbours(queue[head]))
        if (next[w] == kNoLocal && rank_[w] < next_) {
          next[w] = queue[head];
          queue.push_back(w);
        }
    }
    std::vector<Local> way;
    for (Local v = from; v != to; v = next[v]) way.push_back(next[v]);
    return way;
  }

  /// Leads the right agent to a vertex. False: somebody is in its way who cannot be exchanged. May
  /// stop on the way when a limit is met.
  bool settle(Local v, LimitMonitor& limits) {
    const Local agent = goal_.agent_at(v);
    if (board_.vertex_of(agent) == v) return true;
    for (const Local to : way_to(board_.vertex_of(agent), v)) {
      if (limits.exhausted()) return true;
      const Local from = board_.vertex_of(agent);
      if (exchanger_.free(to, std::span(&from, 1), nullptr, rank_, next_))
        board_.move(agent, to);
      else if (!exchanger_.exchange(agent, board_.agent_at(to)))
        return false;
      QUADRILLE_REQUIRE(board_.vertex_of(agent) == to, "each step leads nearer to the goal");
    }
    return true;
  }

  State finish() {
    board_.replace_shifts(without_loops(board_.shifts(), starts_, graph_.size(), kRounds));
    return State::found;
  }

  void shorten_if_long() {
    if (board_.shifts().size() < long_) return;
    board_.replace_shifts(without_loops(board_.shifts(), starts_, graph_.size(), 1));
    long_ = std::max(kManyShifts, 2 * board_.shifts().size());
  }

  const LocalGraph graph_;
  const std::vector<Local> starts_;
  const std::vector<AgentId> agents_;
  const std::vector<VertexId> vertices_;
  Board board_, goal_;
  Exchanger exchanger_;
  const Local num_free_;
  const std::vector<Local> order_;
  std::vector<Local> rank_;  // In the order.
  Local next_;               // Vertices of this rank and more are settled.
  bool has_begun_ = false;
  std::size_t long_ = kManyShifts;
  std::int64_t effort_ = 0;
};

}  // namespace

class Settling::Impl {
 public:
  explicit Impl(const Instance& instance) : num_agents_(instance.num_agents()) {
    ComponentNumbering numbering(instance.graph());
    std::vector<Component> components;
    for (const AgentId agent : instance.agent_ids()) {
      const auto [start, goal] = instance.agents()[agent];
      if (numbering.component_of(start) == kNoLocal) components.push_back(numbering.explore(start));
      if (numbering.component_of(goal) != numbering.component_of(start)) {
        state_ = State::given_up;
        return;
      }
      components[numbering.component_of(start)].agents.push_back(agent);
    }
    for (const Component& component : components) {
      std::vector<Local> starts, goals;
      for (const AgentId agent : component.agents) {
        starts.push_back(numbering.number(instance.agents()[agent].start));
        goals.push_back(numbering.number(instance.agents()[agent].goal));
      }
      parts_.emplace_back(component, LocalGraph(component, numbering), std::move(starts),
                          std::move(goals));
    }
    if (parts_.empty()) state_ = State::found;
  }

  State advance(std::int64_t effort, LimitMonitor& limits) {
    const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
    while (state_ == State::working && effort_ < enough && !limits.exhausted()) {
      ComponentSettling& part = parts_[next_part_];
      const std::int64_t before = part.effort();
      const State state = part.step(limits);
      effort_ += part.effort() - before + 1;
      if (state == State::given_up) state_ = state;
      if (state == State::found && ++next_part_ == parts_.size()) state_ = state;
    }
    return state_;
  }
  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

  [[nodiscard]] std::optional<Plan> plan(LimitMonitor& limits) const {
    QUADRILLE_REQUIRE(state_ == State::found, "there is a plan");
    Plan plan;
    plan.paths.resize(num_agents_);
    for (const ComponentSettling& part : parts_)
      if (!part.write(plan, limits)) return std::nullopt;
    return plan;
  }

 private:
  const std::size_t num_agents_;
  std::deque<ComponentSettling> parts_;
  std::size_t next_part_ = 0;
  State state_ = State::working;
  std::int64_t effort_ = 0;
};

Settling::Settling(const Instance& instance) : impl_(std::make_unique<Impl>(instance)) {}
Settling::~Settling() = default;
Settling::State Settling::advance(std::int64_t effort, LimitMonitor& limits) {
  return impl_->advance(effort, limits);
}
Settling::State Settling::state() const noexcept { return impl_->state(); }
std::int64_t Settling::effort() const noexcept { return impl_->effort(); }
std::optional<Plan> Settling::plan(LimitMonitor& limits) const { return impl_->plan(limits); }

}  // namespace quadrille::discrete
