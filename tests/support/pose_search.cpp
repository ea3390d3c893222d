// SPDX-License-Identifier: MIT
#include "support/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "support/random.hpp"

namespace quadrille::support {
namespace {

constexpr Cost kInfinite = std::numeric_limits<Cost>::max();
constexpr std::size_t kTurns = 4;  // to a full one

/// One robot: where it is, where it faces or is about to, how much of a turn is left, and whether
/// it has decided never to leave its goal again.
struct RobotState {
  std::size_t cell = 0, heading = 0;
  int left = 0;
  bool rests = false;
};
using State = std::vector<RobotState>;

class PoseSearch {
 public:
  PoseSearch(const TurningTask& task, Objective objective)
      : task_(task), sum_(objective == Objective::sum_of_costs) {
    for (const auto& robot : task_.robots) far_.push_back(distances_to(robot.goal));
  }

  /// Or a larger number than `limit`.
  [[nodiscard]] std::size_t count_states(std::size_t limit) const {
    std::size_t count = 1;
    for (std::size_t i = 0; i < task_.robots.size() && count <= limit; ++i)
      count *= states_per_robot();
    return count;
  }

  [[nodiscard]] TurningAnswer run(std::size_t num_states) {
    best_.assign(num_states, kInfinite);
    std::vector<bool> closed(num_states);
    State start;
    for (const auto& robot : task_.robots) start.push_back({robot.start, robot.heading, 0, false});
    reach(start, 0);
    for (std::size_t f = 0; f < buckets_.size(); ++f)
      while (!buckets_[f].empty()) {
        const std::size_t id = buckets_[f].back();
        buckets_[f].pop_back();
        if (closed[id]) continue;
        closed[id] = true;
        const State state = decode(id);
        if (is_final(state)) return {Status::optimal, best_[id]};
        expand(state, best_[id]);
      }
    return {Status::infeasible, 0};
  }

 private:
  [[nodiscard]] std::size_t num_cells() const { return task_.width * task_.height; }
  [[nodiscard]] std::size_t states_per_robot() const {
    return num_cells() * kTurns * static_cast<std::size_t>(task_.turn) * (sum_ ? 2 : 1);
  }

  [[nodiscard]] std::size_t encode(const State& state) const {
    std::size_t code = 0;
    for (const RobotState& robot : state) {
      code = (code * num_cells() + robot.cell) * kTurns + robot.heading;
      code = code * static_cast<std::size_t>(task_.turn) + static_cast<std::size_t>(robot.left);
      if (sum_) code = code * 2 + (robot.rests ? 1 : 0);
    }
    return code;
  }
  [[nodiscard]] State decode(std::size_t code) const {
    State state(task_.robots.size());
    const auto take = [&code](std::size_t base) {
      const std::size_t digit = code % base;
      code /= base;
      return digit;
    };
    for (std::size_t i = state.size(); i-- > 0;) {
      if (sum_) state[i].rests = take(2) == 1;
      state[i].left = static_cast<int>(take(static_cast<std::size_t>(task_.turn)));
      state[i].heading = take(kTurns);
      state[i].cell = take(num_cells());
    }
    return state;
  }

  /// The cell ahead; nullopt if there is none or it is blocked.
  [[nodiscard]] std::optional<std::size_t> ahead(std::size_t cell, std::size_t heading) const {
    std::size_t x = cell % task_.width, y = cell / task_.width;
    if (heading == 0 && ++x == task_.width) return std::nullopt;
    if (heading == 1 && ++y == task_.height) return std::nullopt;
    if (heading == 2 && x-- == 0) return std::nullopt;
    if (heading == 3 && y-- == 0) return std::nullopt;
    const std::size_t next = y * task_.width + x;
    return task_.passable[next] ? std::optional(next) : std::nullopt;
  }

  /// What a robot can be one timestep later.
  [[nodiscard]] std::vector<RobotState> next_of(const RobotState& robot) const {
    if (robot.left > 0) return {{robot.cell, robot.heading, robot.left - 1, false}};
    std::vector<RobotState> next{robot};
    if (robot.rests) return next;
    if (const auto cell = ahead(robot.cell, robot.heading))
      next.push_back({*cell, robot.heading, 0, false});
    for (const std::size_t turned : {robot.heading + 1, robot.heading + 3})
      next.push_back({robot.cell, turned % kTurns, task_.turn - 1, false});
    return next;
  }

  /// How many cells lie between each cell and the goal; turns count nothing.
  [[nodiscard]] std::vector<Cost> distances_to(std::size_t goal) const {
    std::vector<Cost> distance(num_cells(), kInfinite);
    std::vector<std::size_t> queue{goal};
    distance[goal] = 0;
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (std::size_t heading = 0; heading < kTurns; ++heading)
        if (const auto next = ahead(queue[head], heading); next && distance[*next] == kInfinite) {
          distance[*next] = distance[queue[head]] + 1;
          queue.push_back(*next);
        }
    return distance;
  }
  [[nodiscard]] Cost estimate(const State& state) const {
    Cost total = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      const Cost distance = far_[i][state[i].cell];
      if (distance == kInfinite) return kInfinite;
      total = sum_ ? total + distance : std::max(total, distance);
    }
    return total;
  }

  [[nodiscard]] bool is_there(const State& state, std::size_t i) const {
    return state[i].cell == task_.robots[i].goal && state[i].left == 0;
  }
  [[nodiscard]] bool is_final(const State& state) const {
    for (std::size_t i = 0; i < state.size(); ++i)
      if (sum_ ? !state[i].rests : !is_there(state, i)) return false;
    return true;
  }

  void reach(const State& state, Cost cost) {
    const Cost rest = estimate(state);
    const std::size_t id = encode(state);
    if (rest == kInfinite || cost >= best_[id]) return;
    best_[id] = cost;
    const auto bucket = static_cast<std::size_t>(cost + rest);
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(id);
  }

  void expand(const State& state, Cost cost) {
    Cost price = sum_ ? 0 : 1;
    for (std::size_t i = 0; sum_ && i < state.size(); ++i) {
      if (state[i].rests) continue;
      ++price;
      if (!is_there(state, i)) continue;
      State resting = state;
      resting[i].rests = true;
      reach(resting, cost);
    }
    State next = state;
    step(state, next, 0, cost + price);
  }

  /// All that the robots from `i` on can do, where those before it have become `next`.
  void step(const State& state, State& next, std::size_t i, Cost cost) {
    if (i == state.size()) return reach(next, cost);
    for (const RobotState& then : next_of(state[i])) {
      bool is_free = true;
      for (std::size_t j = 0; j < i && is_free; ++j)
        is_free = next[j].cell != then.cell &&
                  !(next[j].cell == state[i].cell && state[j].cell == then.cell);
      if (!is_free) continue;
      next[i] = then;
      step(state, next, i + 1, cost);
    }
  }

  const TurningTask& task_;
  bool sum_;
  std::vector<std::vector<Cost>> far_;
  std::vector<Cost> best_;
  std::vector<std::vector<std::size_t>> buckets_;
};

}  // namespace

TurningAnswer search_poses(const TurningTask& task, Objective objective, std::size_t max_states) {
  PoseSearch search(task, objective);
  const std::size_t num_states = search.count_states(max_states);
  if (num_states > max_states) return {};
  return search.run(num_states);
}

TurningTask random_turning_task(std::uint64_t seed) {
  Random random(seed);
  TurningTask task;
  task.width = random.between(2, 4);
  task.height = random.between(1, 3);
  task.turn = random.percent(70) ? 1 : static_cast<int>(random.between(2, 3));
  const std::size_t blocked = random.below(4) * 10;
  std::vector<std::size_t> starts;
  for (std::size_t cell = 0; cell < task.width * task.height; ++cell) {
    task.passable.push_back(cell == 0 || !random.percent(blocked));
    if (task.passable.back()) starts.push_back(cell);
  }
  std::vector<std::size_t> goals = starts;
  random.shuffle(starts);
  random.shuffle(goals);
  // As many as the joint search finds quickly.
  const std::size_t states = 2 * 4 * starts.size() * static_cast<std::size_t>(task.turn);
  std::size_t count = std::min(starts.size(), random.between(1, 4));
  while (std::pow(states, count) > 550'000) --count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t heading = random.below(4);
    task.robots.push_back({starts[i], heading, goals[i]});
  }
  // Seldom two have one goal.
  if (count > 1 && random.percent(3)) task.robots[1].goal = task.robots[0].goal;
  return task;
}

std::string describe(const TurningTask& task) {
  std::string text = "turn " + std::to_string(task.turn) + "\n";
  for (std::size_t cell = 0; cell < task.passable.size(); ++cell) {
    text += task.passable[cell] ? '.' : '@';
    if ((cell + 1) % task.width == 0) text += '\n';
  }
  for (const auto& robot : task.robots)
    text += std::to_string(robot.start) + " " + std::to_string(robot.heading) + " -> " +
            std::to_string(robot.goal) + "\n";
  return text;
}

}  // namespace quadrille::support
