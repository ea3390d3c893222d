// SPDX-License-Identifier: MIT
#include "rules/infeasible.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace quadrille_check {
namespace {

constexpr int kNone = -1;

/// A component of the graph, and what is left of it without some of its places.
class Component {
 public:
  /// The component of `place`. Throws Rejected if an agent is in it and its goal is not.
  Component(const Instance& instance, int place)
      : instance_(instance),
        piece_(static_cast<std::size_t>(instance.num_places()), kOutside),
        start_at_(piece_.size(), kNone),
        goal_at_(piece_.size(), kNone) {
    const std::vector<int> distance = instance.distances(place);
    for (std::size_t at = 0; at < piece_.size(); ++at)
      if (distance[at] != kFar) {
        piece_[at] = kUnknown;
        ++num_free_;
      }
    for (std::size_t i = 0; i < instance.agents().size(); ++i) {
      const auto& [start, goal] = instance.agents()[i];
      if (!has(start)) continue;
      require(has(goal), "an agent has no way to its goal");
      start_at_[static_cast<std::size_t>(start)] = goal_at_[static_cast<std::size_t>(goal)] =
          static_cast<int>(i);
      --num_free_;
      ++num_agents_;
    }
  }

  [[nodiscard]] bool has(int place) const { return piece(place) != kOutside; }
  [[nodiscard]] Int num_free() const { return num_free_; }
  [[nodiscard]] Int size() const { return num_free_ + num_agents_; }
  /// Who begins or ends there; kNone: nobody.
  [[nodiscard]] int agent_at(int place, bool at_goals) const {
    return (at_goals ? goal_at_ : start_at_)[static_cast<std::size_t>(place)];
  }

  /// Takes places away, each once. False: one of the pieces that are left is joined to them by more
  /// than one edge. Throws Rejected if they are not of this component.
  [[nodiscard]] bool take_away(std::span<const Int> places) {
    for (const Int place : places) {
      require(instance_.has(place) && has(static_cast<int>(place)), "no place of the component");
      require(!is_taken(static_cast<int>(place)), "a place is named twice");
      taken_.push_back(static_cast<int>(place));
      piece_[static_cast<std::size_t>(place)] = kTaken;
    }
    for (const int place : taken_)
      for (const int next : instance_.neighbours(place)) {
        if (is_taken(next)) continue;
        if (piece(next) != kUnknown) return false;
        flood(next);
        joined_to_.push_back(place);
      }
    return true;
  }
  [[nodiscard]] const std::vector<int>& taken() const { return taken_; }
  [[nodiscard]] bool is_taken(int place) const { return piece(place) == kTaken; }
  [[nodiscard]] Int num_taken_neighbours(int place) const {
    const auto next = instance_.neighbours(place);
    return std::count_if(next.begin(), next.end(), [&](int other) { return is_taken(other); });
  }
  /// By number, of a place that is left. By piece: the taken place that it is joined to.
  [[nodiscard]] int piece(int place) const { return piece_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] const std::vector<int>& joined_to() const { return joined_to_; }

 private:
  static constexpr int kOutside = -1, kUnknown = -2, kTaken = -3;

  void flood(int first) {
    const int number = static_cast<int>(joined_to_.size());
    std::vector<int> todo{first};
    piece_[static_cast<std::size_t>(first)] = number;
    while (!todo.empty()) {
      const int place = todo.back();
      todo.pop_back();
      for (const int next : instance_.neighbours(place)) {
        if (piece(next) != kUnknown) continue;
        piece_[static_cast<std::size_t>(next)] = number;
        todo.push_back(next);
      }
    }
  }

  const Instance& instance_;
  std::vector<int> piece_, start_at_, goal_at_, taken_, joined_to_;
  Int num_free_ = 0, num_agents_ = 0;
};

/// No vertex is free, so that agents rotate along cycles, and none of these has the edge.
bool is_behind_bridge(const Instance& instance, const Instance::Agent& agent, int a, int b) {
  require(instance.are_joined(a, b), "no such edge");
  if (Component(instance, agent.start).num_free() > 0) return false;
  std::vector<bool> seen(static_cast<std::size_t>(instance.num_places()), false);
  std::vector<int> todo{agent.start};
  seen[static_cast<std::size_t>(agent.start)] = true;
  while (!todo.empty()) {
    const int place = todo.back();
    todo.pop_back();
    for (const int next : instance.neighbours(place)) {
      if (seen[static_cast<std::size_t>(next)] || std::minmax(place, next) == std::minmax(a, b))
        continue;
      seen[static_cast<std::size_t>(next)] = true;
      todo.push_back(next);
    }
  }
  return !seen[static_cast<std::size_t>(agent.goal)];
}

/// Whether no agent leaves the places that were taken away: they are all, or none is free anywhere
/// and all edges that leave them are bridges.
bool is_closed(const Component& component) {
  return component.num_free() == 0 ||
         static_cast<Int>(component.taken().size()) == component.size();
}

std::vector<int> agents_along(const Component& component, bool at_goals) {
  std::vector<int> agents;
  for (const int place : component.taken())
    if (const int agent = component.agent_at(place, at_goals); agent != kNone)
      agents.push_back(agent);
  return agents;
}

bool is_other_order(const Instance& instance, const Component& component) {
  const std::vector<int>& cycle = component.taken();
  for (std::size_t k = 0; k < cycle.size(); ++k)
    if (!instance.are_joined(cycle[k], cycle[(k + 1) % cycle.size()]) ||
        component.num_taken_neighbours(cycle[k]) != 2)
      return false;
  const std::vector<int> before = agents_along(component, false);
  std::vector<int> after = agents_along(component, true);
  if (cycle.size() < 3 || before.empty() || before.size() != after.size()) return false;
  const auto first = std::find(after.begin(), after.end(), before[0]);
  if (first == after.end()) return false;
  std::rotate(after.begin(), first, after.end());
  return before != after;
}

/// Whether all cycles have odd lengths: no two that a spanning tree and one more edge make share an
/// edge, so that these are all.
bool are_cycles_odd(const Instance& instance, const Component& component) {
  const auto size = static_cast<std::size_t>(instance.num_places());
  std::vector<int> parent(size, kNone), depth(size, kNone);
  std::vector<bool> is_used(size, false);  // the edge to the parent, by a cycle
  std::vector<int> order{component.taken().front()};
  depth[static_cast<std::size_t>(order[0])] = 0;
  const auto at = [](int place) { return static_cast<std::size_t>(place); };
  for (std::size_t head = 0; head < order.size(); ++head)
    for (const int next : instance.neighbours(order[head])) {
      if (!component.is_taken(next) || depth[at(next)] != kNone) continue;
      depth[at(next)] = depth[at(order[head])] + 1;
      parent[at(next)] = order[head];
      order.push_back(next);
    }
  if (order.size() != component.taken().size()) return false;
  for (const int place : order)
    for (int other : instance.neighbours(place)) {
      if (!component.is_taken(other) || other >= place || parent[at(place)] == other ||
          parent[at(other)] == place)
        continue;
      Int length = 1;
      for (int low = place; low != other; ++length) {
        if (depth[at(low)] < depth[at(other)]) std::swap(low, other);
        if (is_used[at(low)]) return false;
        is_used[at(low)] = true;
        low = parent[at(low)];
      }
      if (length % 2 == 0) return false;
    }
  return true;
}

bool is_odd_permutation(const Instance& instance, const Component& component) {
  std::vector<bool> seen(static_cast<std::size_t>(instance.num_places()), false);
  bool is_odd = false;
  for (const int first : component.taken())
    for (int place = first, k = 0; !seen[static_cast<std::size_t>(place)]; ++k) {
      seen[static_cast<std::size_t>(place)] = true;
      place = instance.agents()[static_cast<std::size_t>(component.agent_at(place, false))].goal;
      if (!component.is_taken(place)) return false;
      is_odd = is_odd != (k > 0);
    }
  return is_odd;
}

/// The agent's place in a corridor: 0: on the side of its first vertex; k: the k-th between the two
/// sides; the largest: on the other one.
Int place_in_corridor(const Component& component, const std::vector<bool>& is_beyond,
                      const Instance& instance, int agent, bool at_goals) {
  const auto where = [&](const Instance::Agent& a) { return at_goals ? a.goal : a.start; };
  const Int inside = static_cast<Int>(component.taken().size()) - component.num_free();
  Int free_before = 0;
  for (int place = 0; place < instance.num_places(); ++place) {
    const int piece = component.piece(place);
    if (piece >= 0 && !is_beyond[static_cast<std::size_t>(piece)] &&
        component.agent_at(place, at_goals) == kNone)
      ++free_before;
  }
  const int own = where(instance.agents()[static_cast<std::size_t>(agent)]);
  if (const int piece = component.piece(own); piece >= 0)
    return is_beyond[static_cast<std::size_t>(piece)] ? inside + 1 : 0;
  const std::vector<int> agents = agents_along(component, at_goals);
  const Int rank = std::find(agents.begin(), agents.end(), agent) - agents.begin();
  return rank < free_before ? 0 : std::min(rank - free_before, inside) + 1;
}

bool is_elsewhere_in_corridor(const Instance& instance, const Component& component, int agent,
                              Int beyond) {
  const std::vector<int>& path = component.taken();
  const std::size_t last = path.size() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    if ((k < last && !instance.are_joined(path[k], path[k + 1])) ||
        component.num_taken_neighbours(path[k]) != (k > 0 ? 1 : 0) + (k < last ? 1 : 0))
      return false;
  if (static_cast<Int>(path.size()) < component.num_free()) return false;
  std::vector<bool> is_beyond;
  for (std::size_t piece = 0; piece < component.joined_to().size(); ++piece) {
    const int end = component.joined_to()[piece];
    if (end != path[0] && end != path[last]) return false;
    is_beyond.push_back(last > 0
                            ? end == path[last]
                            : instance.has(beyond) && component.piece(static_cast<int>(beyond)) ==
                                                          static_cast<int>(piece));
  }
  return place_in_corridor(component, is_beyond, instance, agent, false) !=
         place_in_corridor(component, is_beyond, instance, agent, true);
}

}  // namespace

bool is_infeasible(const Instance& instance, std::span<const Int> values) {
  enum : Int { component = 1, bridge = 2, cycle = 3, parity = 4, corridor = 5 };
  require(values.size() >= 2, "the record is too short");
  const Int kind = values[0];
  if (kind == cycle || kind == parity) {
    const auto places = values.subspan(1);
    require(instance.has(places[0]), "no such place");
    Component of(instance, static_cast<int>(places[0]));
    if (!of.take_away(places) || !is_closed(of)) return false;
    if (kind == cycle) return is_other_order(instance, of);
    return of.num_free() == 0 && are_cycles_odd(instance, of) && is_odd_permutation(instance, of);
  }
  require(values[1] >= 0 && values[1] < static_cast<Int>(instance.agents().size()),
          "no such agent");
  const int number = static_cast<int>(values[1]);
  const Instance::Agent& agent = instance.agents()[static_cast<std::size_t>(number)];
  if (kind == component)
    return instance.distances(agent.start)[static_cast<std::size_t>(agent.goal)] == kFar;
  require(values.size() >= 4, "the record is too short");
  if (kind == bridge) {
    require(instance.has(values[2]) && instance.has(values[3]), "no such place");
    return is_behind_bridge(instance, agent, static_cast<int>(values[2]),
                            static_cast<int>(values[3]));
  }
  require(kind == corridor, "no such reason");
  Component of(instance, agent.start);
  return of.take_away(values.subspan(3)) &&
         is_elsewhere_in_corridor(instance, of, number, values[2]);
}

}  // namespace quadrille_check
