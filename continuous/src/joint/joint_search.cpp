// SPDX-License-Identifier: MIT
#include "joint/joint_search.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "joint/joint_times.hpp"
#include "joint/zone.hpp"

namespace quadrille::continuous {
namespace {

enum class Aim { any_plan, sum_of_costs, makespan };

/// Best-first search over pairs of places and zones. The variables of a zone are tick 0 (nobody
/// asks for it when costs do not matter), now, and one per agent: when the move began that it is
/// on; for the sum of costs, of an agent that stands at its goal, when it arrived there, or later.
class JointSearch {
 public:
  JointSearch(Scene& scene, Aim aim, const std::vector<AgentId>& agents, Cost below,
              std::int64_t& work)
      : limits_(scene.limits()),
        aim_(aim),
        below_(below),
        work_(work),
        instance_(scene.instance()),
        space_(scene, agents),
        work_per_step_(static_cast<std::int64_t>(num_variables() * num_variables())) {
    for (const AgentId i : agents) tasks_.push_back(scene.task(i));
  }

  JointReport run() {
    JointReport report;
    add_start();
    while (!heap_.empty()) {
      const Entry top = heap_.front();
      report.lower_bound = aim_ == Aim::any_plan ? 0 : top.cost;
      if (work_ < 0 || limits_.exhausted()) return report;
      std::pop_heap(heap_.begin(), heap_.end(), is_later);
      heap_.pop_back();
      if (nodes_[top.node].is_covered) continue;
      if (space_.are_goals(nodes_[top.node].places)) {
        report.end = JointReport::End::found;
        report.paths = paths_to(top.node);
        return report;
      }
      expand(top.node);
    }
    report.end = JointReport::End::exhausted;
    report.lower_bound = below_;
    return report;
  }

 private:
  /// Of keeping a node, in steps; so that memory is bounded by work, too.
  static constexpr std::int64_t kWorkOfNode = 8;
  static constexpr std::size_t kZero = 0, kNow = 1, kFirstAgent = 2;

  struct Node {
    JointPlaces places;
    Zone zone;
    std::uint32_t parent;
    JointStep step;  // that led here
    bool is_covered = false;
  };
  struct Entry {
    Cost cost, left;
    std::uint32_t node;
  };
  /// Costs less, else is nearer to the goals, else was found later.
  static bool is_later(const Entry& a, const Entry& b) {
    if (a.cost != b.cost) return a.cost > b.cost;
    if (a.left != b.left) return a.left > b.left;
    return a.node < b.node;
  }
  struct PlacesHash {
    std::size_t operator()(const JointPlaces& places) const {
      std::uint64_t hash = places.late;
      for (const std::uint32_t place : places.place)
        hash = (hash ^ place ^ hash >> 29) * 0x9E3779B97F4A7C15ull;
      return static_cast<std::size_t>(hash ^ hash >> 32);
    }
  };

  [[nodiscard]] Ticks distance(std::size_t k, VertexId v) const { return tasks_[k].distances[v]; }
  [[nodiscard]] std::size_t num_variables() const { return kFirstAgent + space_.size(); }
  [[nodiscard]] static std::size_t variable(std::size_t k) { return kFirstAgent + k; }

  void add_start() {
    Node start{space_.starts(), Zone(num_variables()), 0, {}};
    for (std::size_t k = 0; k < space_.size(); ++k)
      if (distance(k, space_.vertex(start.places, k)) >= kForever) return;
    if (aim_ != Aim::any_plan) {
      // Now is tick 0 or later.
      static_cast<void>(start.zone.restrict(kZero, kNow, 0));
      if (aim_ == Aim::sum_of_costs)
        for (std::size_t k = 0; k < space_.size(); ++k)
          if (space_.stands_at_goal(start.places, k))
            static_cast<void>(start.zone.restrict(kZero, variable(k), 0));
    }
    add(std::move(start));
  }

  void expand(std::uint32_t parent) {
    space_.list_steps(nodes_[parent].places, steps_);
    for (const JointStep& step : steps_) {
      work_ -= work_per_step_;
      const JointPlaces& places = nodes_[parent].places;
      if (!step.begins &&
          distance(step.agent, instance_.roadmap().edge(EdgeId(step.edge)).to) >= kForever)
        continue;
      Node next{space_.after(places, step), nodes_[parent].zone, parent, step};
      space_.list_limits(places, step, ages_);
      if (!restrict_ages(next.zone)) continue;
      set_variables(next);
      // Time may go by until something has to happen.
      space_.list_deadlines(next.places, ages_);
      if (!restrict_ages(next.zone)) continue;
      next.zone.free_above(kNow);
      if (!restrict_ages(next.zone)) continue;
      add(std::move(next));
    }
  }

  [[nodiscard]] bool restrict_ages(Zone& zone) const {
    return std::all_of(ages_.begin(), ages_.end(), [&](const AgeLimit& a) {
      return a.is_least ? zone.restrict(variable(a.agent), kNow, -a.age)
                        : zone.restrict(kNow, variable(a.agent), a.age);
    });
  }

  /// After an event.
  void set_variables(Node& next) const {
    const std::size_t k = next.step.agent;
    const bool is_done =
        aim_ == Aim::sum_of_costs && !next.step.begins && space_.stands_at_goal(next.places, k);
    if (next.step.begins || is_done)
      next.zone.assign(variable(k), kNow);
    else
      next.zone.forget(variable(k));
    // More cost is no good, so this adds no better plan; but it makes zones alike.
    if (is_done) next.zone.free_above(variable(k));
  }

  void add(Node next) {
    const auto [cost, left] = estimate(next);
    if (cost >= below_) return;
    auto& known = known_[next.places];
    for (const std::uint32_t other : known) {
      work_ -= work_per_step_ / 4;
      if (nodes_[other].zone.includes(next.zone)) return;
    }
    std::erase_if(known, [&](std::uint32_t other) {
      nodes_[other].is_covered = next.zone.includes(nodes_[other].zone);
      return nodes_[other].is_covered;
    });
    work_ -= kWorkOfNode * work_per_step_;
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    known.push_back(index);
    nodes_.push_back(std::move(next));
    heap_.push_back({cost, left, index});
    std::push_heap(heap_.begin(), heap_.end(), is_later);
  }

  [[nodiscard]] Ticks least(const Zone& zone, std::size_t x) const { return -zone.most(kZero, x); }

  /// What plans from here cost at least, and how much of that is left to be done.
  [[nodiscard]] std::pair<Cost, Cost> estimate(const Node& node) const {
    Cost sum = 0, largest = 0, left = 0;
    for (std::size_t k = 0; k < space_.size(); ++k) {
      Ticks to_go = 0;
      std::size_t since = kNow;
      if (space_.is_moving(node.places, k)) {
        const EdgeId e = space_.edge(node.places, k);
        to_go = space_.duration(k, e) + distance(k, instance_.roadmap().edge(e).to);
        since = variable(k);
      } else if (!space_.stands_at_goal(node.places, k)) {
        to_go = distance(k, space_.vertex(node.places, k));
      } else if (aim_ == Aim::sum_of_costs) {
        since = variable(k);
      }
      left += to_go;
      if (aim_ == Aim::any_plan) continue;
      const Cost cost = least(node.zone, since) + to_go;
      sum += cost;
      largest = std::max(largest, cost);
    }
    if (aim_ == Aim::any_plan) return {left, left};
    return {aim_ == Aim::sum_of_costs ? sum : largest, left};
  }

  [[nodiscard]] std::vector<Path> paths_to(std::uint32_t node) {
    std::vector<JointStep> steps;
    for (; node != 0; node = nodes_[node].parent) steps.push_back(nodes_[node].step);
    std::reverse(steps.begin(), steps.end());
    return earliest_paths(instance_, space_, steps);
  }

  LimitMonitor& limits_;
  const Aim aim_;
  const Cost below_;
  std::int64_t& work_;
  const Instance& instance_;
  JointSpace space_;
  const std::int64_t work_per_step_;
  std::vector<PathTask> tasks_;
  std::vector<Node> nodes_;
  std::vector<Entry> heap_;
  std::unordered_map<JointPlaces, std::vector<std::uint32_t>, PlacesHash> known_;
  std::vector<JointStep> steps_;
  std::vector<AgeLimit> ages_;
};

}  // namespace

JointReport find_joint_plan(Scene& scene, const std::vector<AgentId>& agents, std::int64_t& work) {
  return JointSearch(scene, Aim::any_plan, agents, kForever, work).run();
}

JointReport find_cheapest_joint_plan(Scene& scene, Objective objective, std::optional<Cost> below,
                                     std::int64_t& work) {
  std::vector<AgentId> agents;
  for (const AgentId i : scene.instance().agent_ids()) agents.push_back(i);
  const Aim aim = objective == Objective::makespan ? Aim::makespan : Aim::sum_of_costs;
  return JointSearch(scene, aim, agents, below.value_or(kForever), work).run();
}

}  // namespace quadrille::continuous
