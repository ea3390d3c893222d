// SPDX-License-Identifier: MIT
#include "joint/joint_search.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "joint/joint_times.hpp"
#include "joint/zone.hpp"

namespace quadrille::continuous {
namespace {

enum class Aim { any_plan, sum_of_costs, makespan };

/// Best-first search over pairs of places and zones. The variables of a zone are now, one per
/// agent, and, if costs or the clock matter, tick 0. That of an agent is when the move began that
/// it is on; for the sum of costs, of an agent that is at its goal, when it arrived there, or
/// later.
class JointSearch {
 public:
  JointSearch(Scene& scene, Aim aim, const std::vector<AgentId>& agents, JointRules rules,
              Cost below, std::int64_t& work)
      : limits_(scene.limits()),
        aim_(aim),
        below_(below),
        work_(work),
        instance_(scene.instance()),
        space_(scene, agents, rules),
        zero_(kFirstAgent + agents.size()),
        num_variables_(aim == Aim::any_plan && !space_.has_clock() ? zero_ : zero_ + 1),
        work_per_step_(static_cast<std::int64_t>(num_variables_ * num_variables_)),
        known_(kFirstSize, kNone),
        next_{{}, Zone(num_variables_), kNone, kNone, {}} {
    for (const AgentId i : agents) {
      tasks_.push_back(scene.task(i));
      free_costs_.push_back(rules == JointRules::all ? scene.free_cost(i) : 0);
    }
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
  static constexpr std::size_t kNow = 0, kFirstAgent = 1;
  static constexpr std::uint32_t kNone = UINT32_MAX;
  static constexpr std::size_t kFirstSize = 1024;  // a power of two, of the hash table

  struct Node {
    JointPlaces places;
    Zone zone;
    std::uint32_t parent;
    std::uint32_t next_known;  // of the same places
    JointStep step;            // that led here
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
  [[nodiscard]] Ticks distance(std::size_t k, VertexId v) const { return tasks_[k].distances[v]; }
  [[nodiscard]] static std::size_t variable(std::size_t k) { return kFirstAgent + k; }

  void add_start() {
    const auto places = space_.starts();
    if (!places) return;
    next_.places = *places;
    for (std::size_t k = 0; k < space_.size(); ++k)
      if (!space_.has_left(*places, k) && distance(k, space_.vertex(*places, k)) >= kForever)
        return;
    if (num_variables_ > zero_) {
      // Now is tick 0 or later.
      static_cast<void>(next_.zone.restrict(zero_, kNow, 0));
      if (!wait_until_latest(next_)) return;
      if (aim_ == Aim::sum_of_costs)
        for (std::size_t k = 0; k < space_.size(); ++k)
          if (space_.is_at_goal(next_.places, k))
            static_cast<void>(next_.zone.restrict(zero_, variable(k), 0));
    }
    add_next();
  }

  void expand(std::uint32_t parent) {
    const JointPlaces places = nodes_[parent].places;
    space_.list_steps(places, steps_);
    for (const JointStep& step : steps_) {
      work_ -= work_per_step_;
      if (!step.begins &&
          distance(step.agent, instance_.roadmap().edge(EdgeId(step.edge)).to) >= kForever)
        continue;
      next_.zone = nodes_[parent].zone;
      space_.list_limits(places, step, ages_);
      if (!restrict_ages(next_.zone) || !restrict_now(next_.zone, space_.when(step))) continue;
      next_.places = space_.after(places, step);
      next_.parent = parent;
      next_.step = step;
      set_variables(next_);
      // Time may go by until something has to happen.
      space_.list_deadlines(next_.places, ages_);
      if (!restrict_ages(next_.zone)) continue;
      next_.zone.free_above(kNow);
      if (!restrict_ages(next_.zone) || !wait_until_latest(next_)) continue;
      add_next();
    }
  }

  [[nodiscard]] bool restrict_ages(Zone& zone) const {
    return std::all_of(ages_.begin(), ages_.end(), [&](const AgeLimit& a) {
      return a.is_least ? zone.restrict(variable(a.agent), kNow, -a.age)
                        : zone.restrict(kNow, variable(a.agent), a.age);
    });
  }

  [[nodiscard]] bool restrict_now(Zone& zone, const ClockSpan& span) const {
    if (!space_.has_clock()) return true;
    return zone.restrict(zero_, kNow, -span.from) &&
           (span.until >= kForever || zone.restrict(kNow, zero_, span.until));
  }
  [[nodiscard]] bool wait_until_latest(Node& node) const {
    return restrict_now(node.zone, {0, space_.latest(node.places)});
  }

  /// After an event.
  void set_variables(Node& next) const {
    const std::size_t k = next.step.agent;
    const bool is_done =
        aim_ == Aim::sum_of_costs && !next.step.begins && space_.is_at_goal(next.places, k);
    if (next.step.begins || is_done)
      next.zone.assign(variable(k), kNow);
    else
      next.zone.forget(variable(k));
    // More cost is no good, so this adds no better plan; but it makes zones alike.
    if (is_done) next.zone.free_above(variable(k));
  }

  /// Keeps it, unless another one includes it.
  void add_next() {
    const auto [cost, left] = estimate(next_);
    if (cost >= below_) return;
    if (nodes_.size() >= kNone) work_ = -1;
    std::uint32_t& first = known(next_.places);
    for (std::uint32_t other = first; other != kNone; other = nodes_[other].next_known) {
      work_ -= work_per_step_ / 4;
      if (nodes_[other].zone.includes(next_.zone)) return;
    }
    for (std::uint32_t* at = &first; *at != kNone;) {
      Node& other = nodes_[*at];
      other.is_covered = next_.zone.includes(other.zone);
      if (other.is_covered)
        *at = other.next_known;
      else
        at = &other.next_known;
    }
    work_ -= kWorkOfNode * work_per_step_;
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    next_.next_known = first;
    first = index;
    nodes_.push_back(next_);
    heap_.push_back({cost, left, index});
    std::push_heap(heap_.begin(), heap_.end(), is_later);
  }

  [[nodiscard]] static std::size_t hash(const JointPlaces& places) {
    std::uint64_t hash = places.late;
    for (std::size_t k = 0; k < kMaxJointAgents; ++k) {
      const std::uint64_t place = std::uint64_t{places.stay[k]} << 32 | places.place[k];
      hash = (hash ^ place ^ hash >> 29) * 0x9E3779B97F4A7C15ull;
    }
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }

  /// The last node of these places that is not covered, in a table with open addresses: this is
  /// where the time goes.
  [[nodiscard]] std::uint32_t& known(const JointPlaces& places) {
    if (2 * num_known_ >= known_.size()) {
      std::vector<std::uint32_t> old(2 * known_.size(), kNone);
      std::swap(old, known_);
      for (const std::uint32_t first : old)
        if (first != kNone) slot(nodes_[first].places) = first;
    }
    std::uint32_t& first = slot(places);
    if (first == kNone) ++num_known_;
    return first;
  }
  [[nodiscard]] std::uint32_t& slot(const JointPlaces& places) {
    std::size_t at = hash(places) & (known_.size() - 1);
    while (known_[at] != kNone && !(nodes_[known_[at]].places == places))
      at = (at + 1) & (known_.size() - 1);
    return known_[at];
  }

  [[nodiscard]] Ticks least(const Zone& zone, std::size_t x) const { return -zone.most(zero_, x); }

  /// What plans from here cost at least, and how much of that is left to be done.
  [[nodiscard]] std::pair<Cost, Cost> estimate(const Node& node) const {
    Cost sum = 0, largest = 0, left = 0;
    for (std::size_t k = 0; k < space_.size(); ++k) {
      Ticks to_go = 0;
      std::size_t since = kNow;
      if (space_.is_moving(node.places, k)) {
        const EdgeId e = space_.edge(node.places, k);
        to_go = space_.duration(k, e) + distance(k, instance_.roadmap().to(e));
        since = variable(k);
      } else if (!space_.is_at_goal(node.places, k)) {
        to_go = distance(k, space_.vertex(node.places, k));
      } else if (aim_ == Aim::sum_of_costs) {
        since = variable(k);
      }
      left += as_cost(to_go);
      if (aim_ == Aim::any_plan) continue;
      const Cost cost = std::max(as_cost(least(node.zone, since) + to_go), free_costs_[k]);
      if (cost >= kAnyCost) return {kAnyCost, left};
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
  const std::size_t zero_, num_variables_;
  const std::int64_t work_per_step_;
  std::vector<PathTask> tasks_;
  std::vector<Cost> free_costs_;  // what they cost alone, as far as the rules tell
  std::deque<Node> nodes_;
  std::vector<Entry> heap_;
  std::vector<std::uint32_t> known_;
  std::size_t num_known_ = 0;
  Node next_;  // being made
  std::vector<JointStep> steps_;
  std::vector<AgeLimit> ages_;
};

}  // namespace

JointScope joint_scope(const Instance& instance) {
  const auto& agents = instance.agents();
  if (std::any_of(agents.begin(), agents.end(), [](const Agent& a) { return a.leaves; }))
    return JointScope::none;
  const bool is_relaxed =
      !instance.obstacles().empty() || !instance.roadmap().no_waiting().empty() ||
      std::any_of(agents.begin(), agents.end(),
                  [](const Agent& a) { return a.release > 0 || a.deadline || a.under_way; });
  return is_relaxed ? JointScope::relaxed : JointScope::exact;
}

JointReport find_joint_plan(Scene& scene, const std::vector<AgentId>& agents, JointRules rules,
                            std::int64_t& work) {
  return JointSearch(scene, Aim::any_plan, agents, rules, kAnyCost, work).run();
}

JointReport find_cheapest_joint_plan(Scene& scene, const std::vector<AgentId>& agents,
                                     Objective objective, std::optional<Cost> below,
                                     std::int64_t& work) {
  const Aim aim = objective == Objective::makespan ? Aim::makespan : Aim::sum_of_costs;
  return JointSearch(scene, aim, agents, JointRules::all, below.value_or(kAnyCost), work).run();
}

}  // namespace quadrille::continuous
