// SPDX-License-Identifier: MIT
#include "flow/one_group.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "quadrille/discrete/goal_distances.hpp"

namespace quadrille::discrete {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// The time-expanded graph and the flow in it, a layer for each timestep.
class Flow {
 public:
  Flow(const Graph& graph, const Goals& goals, std::vector<VertexId> starts,
       std::int64_t most_steps, LimitMonitor& limits)
      : graph_(graph),
        goals_(goals),
        to_goal_(distances_to_nearest(graph, goals)),
        starts_(std::move(starts)),
        steps_left_(most_steps),
        limits_(limits) {}

  /// Units from all starts reach goals in `makespan()` timesteps. False: that was cut short.
  bool run() {
    for (const VertexId start : starts_) end_ = std::max(end_, to_goal_[start]);
    for (Timestep t = 0; t <= end_; ++t)
      if (!add_layer()) return false;
    while (num_units_ < starts_.size()) {
      if (augment()) continue;
      if (is_cut_) return false;
      ++end_;
      if (!add_layer()) return false;
      wait_at_goals();
    }
    return true;
  }
  [[nodiscard]] Timestep makespan() const noexcept { return end_; }

  /// By start. Undoes that units change places.
  [[nodiscard]] std::vector<Path> paths() {
    for (Timestep t = 0; t < end_; ++t)
      for (const VertexId v : IdRange<VertexId>(graph_.num_vertices())) {
        Node& node = at(v, t);
        if (!node.has_unit || node.next == v.value()) continue;
        Node& other = at(VertexId(node.next), t);
        if (!other.has_unit || other.next != v.value()) continue;
        std::swap(node.next, other.next);
      }
    std::vector<Path> paths;
    for (const VertexId start : starts_) {
      Path path{start};
      for (Timestep t = 0; t < end_; ++t) path.emplace_back(at(path.back(), t).next);
      paths.push_back(std::move(path));
    }
    return paths;
  }

 private:
  /// A vertex at a timestep is two nodes, with an arc for one unit from `in` to `out`.
  struct Node {
    std::uint32_t next = kNone, previous = kNone;  // where its unit goes, and where it came from
    bool has_unit = false;
    // Of the search with that number: whether it came to the node, and from which state.
    std::uint32_t seen_in = 0, seen_out = 0;
    std::uint32_t from_in = kNone, from_out = kNone;
  };
  /// A node's `in` or `out`, numbered.
  using State = std::uint32_t;

  [[nodiscard]] std::size_t index(VertexId v, Timestep t) const {
    return static_cast<std::size_t>(t) * graph_.num_vertices() + v.index();
  }
  [[nodiscard]] Node& at(VertexId v, Timestep t) { return nodes_[index(v, t)]; }

  bool add_layer() {
    const std::size_t size = nodes_.size() + graph_.num_vertices();
    if (size >= kNone / 2 || !limits_.has_room_for(graph_.num_vertices() * sizeof(Node)) ||
        limits_.exhausted_now())
      return false;
    nodes_.resize(size);
    return true;
  }
  /// Units that are at goals one timestep before the end stay there.
  void wait_at_goals() {
    for (const VertexId goal : goals_.vertices()) {
      Node& before = at(goal, end_ - 1);
      if (!before.has_unit) continue;
      before.next = goal.value();
      at(goal, end_).has_unit = true;
      at(goal, end_).previous = goal.value();
    }
  }

  /// One more unit, along a path in which units may be sent elsewhere. Breadth first, from all
  /// starts without a unit.
  bool augment() {
    ++search_;
    queue_.clear();
    for (const VertexId start : starts_)
      if (!at(start, 0).has_unit) visit_in(start, 0, kNone);
    for (std::size_t head = 0; head < queue_.size(); ++head) {
      const State state = queue_[head];
      const VertexId v((state / 2) % graph_.num_vertices());
      const auto t = static_cast<Timestep>(state / 2 / graph_.num_vertices());
      if (state % 2 == 0) {
        leave_in(v, t, state);
      } else if (leave_out(v, t, state)) {
        send(state);
        return true;
      }
      if (steps_left_ <= 0 || limits_.exhausted()) {
        is_cut_ = true;
        return false;
      }
    }
    return false;
  }
  void leave_in(VertexId v, Timestep t, State state) {
    const Node& node = at(v, t);
    if (!node.has_unit)
      visit_out(v, t, state);
    else if (t > 0)  // its unit goes another way before it comes here
      visit_out(VertexId(node.previous), t - 1, state);
  }
  /// Whether that is the end.
  bool leave_out(VertexId v, Timestep t, State state) {
    const Node& node = at(v, t);
    if (node.has_unit) visit_in(v, t, state);  // it came there another way
    if (t == end_) return !node.has_unit && goals_.contains(v);
    const auto step = [&](VertexId w) {
      if (!node.has_unit || node.next != w.value()) visit_in(w, t + 1, state);
    };
    step(v);
    for (const VertexId w : graph_.neighbours(v)) step(w);
    return false;
  }
  // From farther away nobody comes to a goal, nor to where a unit is.
  void visit_in(VertexId v, Timestep t, State from) {
    --steps_left_;
    Node& node = at(v, t);
    if (node.seen_in == search_ || to_goal_[v] > end_ - t) return;
    node.seen_in = search_;
    node.from_in = from;
    queue_.push_back(static_cast<State>(2 * index(v, t)));
  }
  void visit_out(VertexId v, Timestep t, State from) {
    Node& node = at(v, t);
    if (node.seen_out == search_) return;
    node.seen_out = search_;
    node.from_out = from;
    queue_.push_back(static_cast<State>(2 * index(v, t) + 1));
  }

  /// Along the path of the search to its last state.
  void send(State last) {
    std::vector<State> path;
    for (State s = last; s != kNone;
         s = s % 2 == 0 ? nodes_[s / 2].from_in : nodes_[s / 2].from_out)
      path.push_back(s);
    std::reverse(path.begin(), path.end());
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const State a = path[k], b = path[k + 1];
      const bool is_from_out = a % 2 == 1, is_to_out = b % 2 == 1, is_same = a / 2 == b / 2;
      if (is_same) {
        nodes_[a / 2].has_unit = is_to_out;
      } else if (is_from_out && !is_to_out) {
        nodes_[a / 2].next = vertex_of(b);
        nodes_[b / 2].previous = vertex_of(a);
      }
    }
    ++num_units_;
  }
  [[nodiscard]] std::uint32_t vertex_of(State state) const {
    return static_cast<std::uint32_t>((state / 2) % graph_.num_vertices());
  }

  const Graph& graph_;
  const Goals& goals_;
  const IdVector<VertexId, Timestep> to_goal_;
  const std::vector<VertexId> starts_;
  std::int64_t steps_left_;
  LimitMonitor& limits_;
  Timestep end_ = 0;
  std::vector<Node> nodes_;  // layer by layer
  std::vector<State> queue_;
  std::uint32_t search_ = 0;
  std::size_t num_units_ = 0;
  bool is_cut_ = false;
};

}  // namespace

GroupMakespan least_makespan(const Instance& instance, const std::vector<AgentId>& agents,
                             std::int64_t most_steps, LimitMonitor& limits) {
  std::vector<VertexId> starts;
  for (const AgentId i : agents) starts.push_back(instance.agents()[i].start);
  Flow flow(instance.graph(), instance.agents()[agents.front()].goals, std::move(starts),
            most_steps, limits);
  GroupMakespan known;
  if (flow.run()) known.paths = flow.paths();
  known.lower = flow.makespan();
  return known;
}

std::vector<std::vector<AgentId>> groups_that_share(const Instance& instance) {
  std::map<std::vector<VertexId>, std::vector<AgentId>> groups;
  for (const AgentId i : instance.agent_ids()) {
    const auto goals = instance.agents()[i].goals.vertices();
    groups[{goals.begin(), goals.end()}].push_back(i);
  }
  std::vector<std::vector<AgentId>> several;
  for (auto& [goals, agents] : groups)
    if (agents.size() > 1) several.push_back(std::move(agents));
  return several;
}

}  // namespace quadrille::discrete
