// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/dispatcher.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "origin.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/replanner.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/continuous/verify.hpp"
#include "right_of_way.hpp"
#include "robot.hpp"
#include "unheeded.hpp"
#include "work.hpp"

namespace quadrille::dispatch {
namespace {

/// Who looked for a path in vain tries again after so many calls at most.
constexpr std::int64_t kMostPatience = 16;
/// In calls, where nothing else was asked for: how late a robot may be.
constexpr std::int64_t kPatience = 8;
/// In calls: who has been allowed nothing for so long may be waiting in a circle.
constexpr std::int64_t kStuck = 30;
/// Who tries again only after so many calls has all paths made at once, in fleets of so many robots
/// at most, where that takes some milliseconds.
constexpr std::int64_t kTriesAlone = 16;
constexpr std::size_t kMostAtOnce = 64;
constexpr std::int64_t kConflictsAtOnce = 100;
constexpr double kGapAtOnce = 10;

}  // namespace

class Dispatcher::Parts {
 public:
  Parts(const Instance& instance, const Options& options)
      : options_(options),
        roadmap_(instance.shared_roadmap()),
        roads_(roadmap_),
        resolution_(instance.resolution()),
        replanner_(roadmap_) {
    for (const continuous::Agent& agent : instance.agents()) {
      Robot& robot = robots_.emplace_back();
      robot.agent = agent;
      robot.agent.goals = agent.start;
      robot.course = {{agent.start, 0, 0}};
    }
  }

  std::vector<Robot>& robots() { return robots_; }
  Roads& roads() { return roads_; }
  [[nodiscard]] const execution::Precedences& order() const { return order_; }
  [[nodiscard]] Ticks now() const { return now_; }

  std::optional<Error> assign(AgentId id, Task task) {
    if (auto error = refuse_task(id, robots_.size(), task, geometry::kMaxDuration)) return error;
    if (auto error = refuse(robots_[id.index()].agent, task.goals)) {
      error->message = robot_name(id) + ": " + error->message;
      return error;
    }
    robots_[id.index()].tasks.push_back({std::move(task), num_assigned_++});
    return std::nullopt;
  }

  News tick(Ticks duration, const Limits& limits) {
    News news;
    ++call_;
    for (Robot& robot : robots_) {
      robot.clock = clock_of(robot);
      robot.limit = std::max(robot.limit, robot.clock);
    }
    finish_tasks(news);
    const Ticks patience = options_.patience > 0 ? options_.patience : kPatience * duration;
    if (find_barred() || now_ - earliest_that_moves() > patience)
      news.has_new_origin = begin_anew();
    if (news.has_new_origin) give_way();
    plan(limits, news);
    release(duration);
    for (const Robot& robot : robots_)
      news.num_waiting += robot.wants_path() || (robot.is_barred && !robot.tasks.empty()) ? 1 : 0;
    return news;
  }

 private:
  /// By one that is alone.
  [[nodiscard]] std::optional<Error> refuse(continuous::Agent agent, const Goals& goals) const {
    agent.goals = goals;
    const auto alone = Instance::make(roadmap_, {std::move(agent)}, resolution_);
    if (!alone) return alone.error();
    return std::nullopt;
  }

  void finish_tasks(News& news) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      if (robot.is_bound && !robot.busy_until && robot.has_arrived())
        robot.busy_until = now_ + robot.tasks.front().task.service;
      if (!robot.busy_until || *robot.busy_until > now_) continue;
      news.served.push_back(AgentId(i));
      robot.tasks.pop_front();
      robot.busy_until.reset();
      robot.is_bound = false;
      robot.next_try = 0;
      robot.patience = 1;
    }
  }

  /// Robots that follow each other in a circle without slack wait for ever: the one that has waited
  /// for longest goes elsewhere, if it is at a vertex and can.
  void give_way() {
    Robot* longest = nullptr;
    for (Robot& robot : robots_)
      if (robot.num_stuck >= kStuck && !robot.busy_until &&
          spot_at(robot.course, now_).is_vertex() &&
          (longest == nullptr || robot.num_stuck > longest->num_stuck))
        longest = &robot;
    if (longest == nullptr) return;
    longest->num_stuck = 0;
    longest->is_barred = true;
    longest->is_bound = false;
  }

  /// Those whose courses lead into lanes that are closed. Whether one should be there already, and
  /// it is time to plan for it from where it is.
  bool find_barred() {
    bool is_late = false;
    for (Robot& robot : robots_) {
      const auto barrier = roads_.barrier(robot.course, robot.limit);
      robot.is_barred = barrier.has_value() && !robot.busy_until;
      if (!robot.is_barred) continue;
      robot.is_bound = false;
      if (*barrier >= now_ || robot.next_try > call_) continue;
      is_late = true;
      robot.patience = std::min(2 * robot.patience, kMostPatience);
      robot.next_try = call_ + robot.patience;
    }
    return is_late;
  }

  /// As the others see it: whoever has arrived is at rest, and late for nothing.
  [[nodiscard]] Ticks clock_of(const Robot& robot) const {
    return robot.has_arrived() ? std::max(robot.clock, now_) : robot.clock;
  }
  /// Of those that have moved since all was planned anew; those that have not may be broken, and
  /// nothing is gained by planning for them once more.
  [[nodiscard]] Ticks earliest_that_moves() const {
    Ticks earliest = now_;
    for (const Robot& robot : robots_)
      if (robot.clock != robot.clock_at_origin) earliest = std::min(earliest, clock_of(robot));
    return earliest;
  }

  [[nodiscard]] std::vector<Course> courses() const {
    std::vector<Course> courses;
    for (const Robot& robot : robots_) courses.push_back(robot.course);
    return courses;
  }
  [[nodiscard]] std::vector<continuous::Agent> agents() const {
    std::vector<continuous::Agent> agents;
    for (const Robot& robot : robots_) agents.push_back(robot.agent);
    return agents;
  }
  [[nodiscard]] Traffic traffic() const {
    Traffic traffic{roadmap_, resolution_, agents(), origin_, {}};
    for (const Robot& robot : robots_) traffic.clocks.push_back(clock_of(robot));
    return traffic;
  }

  bool begin_anew() {
    std::vector<Ticks> clocks, limits;
    for (const Robot& robot : robots_) {
      clocks.push_back(robot.clock);
      limits.push_back(robot.limit);
    }
    NewOrigin made = move_origin(courses(), clocks, limits, now_);
    const auto snapshot =
        take_snapshot_of_ends(roadmap_, resolution_, agents(), made.courses, now_);
    if (!snapshot || !continuous::verify(snapshot->instance, snapshot->plan).valid()) return false;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      robot.course = std::move(made.courses[i]);
      robot.clock = robot.clock_at_origin = made.clocks[i];
      robot.limit = now_;
      robot.is_held = end_of(robot.course) > now_;
    }
    origin_ = now_;
    return true;
  }

  /// New courses from now on, if there is need of any, and if they can be put into force.
  void plan(const Limits& limits, News& news) {
    const Work work = next_work(robots_, *roadmap_, roads_, call_, now_);
    if (options_.effort <= Effort() || (work.order.empty() && !options_.improves)) return;
    std::vector<continuous::Agent> agents = this->agents();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      agents[i].goals = work.goals[i];
      agents[i].release = robots_[i].busy_until.value_or(Ticks(0));
    }
    const std::vector<Course> before = courses();
    const auto snapshot = take_snapshot(roadmap_, resolution_, std::move(agents), before, now_,
                                        roads_.closed_edges());
    if (!snapshot) return;
    replanner_.begin(snapshot->instance, snapshot->plan, limits);
    send(work);
    if (is_somebody_stuck()) plan_all_at_once(*snapshot, limits);
    const bool are_barred = std::any_of(robots_.begin(), robots_.end(),
                                        [](const Robot& robot) { return robot.is_barred; });
    if (options_.improves && !are_barred && replanner_.effort() < options_.effort)
      replanner_.improve(options_.effort - replanner_.effort());
    news.effort = replanner_.effort();
    adopt(*snapshot, before, news);
  }

  void send(const Work& work) {
    sent_.clear();
    std::vector<char> is_on_its_way;  // to its first task
    for (const Robot& robot : robots_) is_on_its_way.push_back(robot.is_bound ? 1 : 0);
    for (const AgentId i : work.order) {
      if (replanner_.effort() >= options_.effort) break;
      const Robot& robot = robots_[i.index()];
      const auto may_push = [&](AgentId j) {
        const Robot& other = robots_[j.index()];
        if (other.busy_until) return false;
        return is_on_its_way[j.index()] == 0 || is_more_urgent(robot, other);
      };
      const bool may_ask = robot.wants_path() || robot.is_barred;
      const bool is_sent = may_ask ? replanner_.send(i, may_push) : replanner_.send(i);
      sent_.emplace_back(i, is_sent);
      if (is_sent && robot.wants_path()) is_on_its_way[i.index()] = 1;
    }
  }

  /// One after the other some never find a path: two that change places beside a siding, say.
  [[nodiscard]] bool is_somebody_stuck() const {
    return robots_.size() <= kMostAtOnce &&
           std::any_of(sent_.begin(), sent_.end(), [this](const auto& sent) {
             const Robot& robot = robots_[sent.first.index()];
             return !sent.second && robot.wants_path() && robot.patience >= kTriesAlone;
           });
  }

  /// By the solver, which looks for all kinds of plans. Nothing changes if it finds none soon.
  void plan_all_at_once(const Snapshot& snapshot, const Limits& limits) {
    continuous::SolveOptions asked;
    asked.limits = limits;
    asked.limits.conflicts = kConflictsAtOnce;
    asked.gap_percent = kGapAtOnce;
    const auto outcome = continuous::solve(snapshot.instance, asked);
    if (!outcome || !outcome->plan) return;
    replanner_.begin(snapshot.instance, *outcome->plan, limits);
    for (auto& [id, is_sent] : sent_) is_sent = true;
  }

  void adopt(const Snapshot& snapshot, const std::vector<Course>& before, News& news) {
    const continuous::Plan plan = replanner_.plan();
    std::vector<Course> after = before;
    for (const AgentId i : snapshot.instance.agent_ids()) {
      if (plan.paths[i] == snapshot.plan.paths[i]) continue;
      news.has_new_plan = true;
      after[i.index()] = joined(until(before[i.index()], now_), snapshot.course(plan.paths[i]));
    }
    if (news.has_new_plan) {
      const auto allowed = find_right_of_way(traffic(), after);
      const auto keeps = [&](std::size_t i) { return allowed->limits[i] >= robots_[i].limit; };
      bool is_kept = allowed.has_value();
      for (std::size_t i = 0; is_kept && i < robots_.size(); ++i) is_kept = keeps(i);
      news.was_too_late = !is_kept;
      news.has_new_plan = is_kept;
    }
    for (const auto& [id, is_sent] : sent_) {
      Robot& robot = robots_[id.index()];
      const bool is_done = is_sent && !news.was_too_late;
      if (is_done) robot.is_held = false;
      if (!robot.wants_path()) continue;
      if (is_done) ++news.num_sent;
      robot.patience = is_done ? 1 : std::min(2 * robot.patience, kMostPatience);
      if (!is_done) robot.next_try = call_ + robot.patience;
    }
    for (const AgentId i : snapshot.instance.agent_ids()) {
      Robot& robot = robots_[i.index()];
      if (news.has_new_plan) robot.course = std::move(after[i.index()]);
      if (roads_.barrier(robot.course, robot.limit)) continue;
      if (std::exchange(robot.is_barred, false)) {
        robot.next_try = 0;
        robot.patience = 1;
      }
      if (!robot.tasks.empty() && !robot.busy_until)
        robot.is_bound = robot.tasks.front().task.goals.contains(robot.course.back().spot.from);
      if (!robot.is_bound || robot.busy_until) continue;
      news.cost += continuous::as_cost(std::max(Ticks(0), end_of(robot.course) - now_));
      news.lower_bound += replanner_.free_cost(i);
    }
  }

  /// Everybody may go on for so long, if the others allow it.
  void release(Ticks duration) {
    auto allowed = find_right_of_way(traffic(), courses());
    QUADRILLE_REQUIRE(allowed.has_value(), "the courses in force do not collide");
    order_ = std::move(allowed->order);
    now_ += duration;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      Ticks limit = std::min(allowed->limits[i], now_);
      if (const auto barrier = roads_.barrier(robot.course, robot.limit))
        limit = std::min(limit, *barrier);
      if (options_.reach > 0 && !robot.has_arrived())
        limit = std::min(limit, robot.clock + options_.reach);
      robot.limit = std::max(robot.limit, limit);
      const bool is_stuck = !robot.has_arrived() && robot.limit <= robot.clock;
      robot.num_stuck = is_stuck ? robot.num_stuck + 1 : 0;
    }
    forget();
  }

  /// What lies before all clocks.
  void forget() {
    Ticks earliest = now_;
    for (const Robot& robot : robots_) earliest = std::min(earliest, clock_of(robot));
    for (Robot& robot : robots_) {
      std::size_t passed = 0;
      while (passed + 1 < robot.course.size() && robot.course[passed + 1].arrive <= earliest)
        ++passed;
      robot.course.erase(robot.course.begin(),
                         robot.course.begin() + static_cast<std::ptrdiff_t>(passed));
    }
  }

  const Options options_;
  const std::shared_ptr<const Roadmap> roadmap_;
  Roads roads_;
  const continuous::Resolution resolution_;
  continuous::Replanner replanner_;
  std::vector<Robot> robots_;
  std::vector<std::pair<AgentId, bool>> sent_;  // of this call: whether it got a path
  execution::Precedences order_;                // of the courses in force
  Ticks now_ = 0, origin_ = 0;
  std::int64_t call_ = 0, num_assigned_ = 0;
};

Result<Dispatcher> Dispatcher::make(std::shared_ptr<const Roadmap> roadmap,
                                    std::vector<continuous::Agent> robots,
                                    continuous::Resolution resolution, const Options& options) {
  for (continuous::Agent& robot : robots) {
    robot.goals = robot.start;
    robot.deadline.reset();
  }
  const auto instance = Instance::make(std::move(roadmap), std::move(robots), resolution);
  if (!instance) return instance.error();
  return make(*instance, options);
}

Result<Dispatcher> Dispatcher::make(const Instance& instance, const Options& options) {
  if (auto error = refuse_unheeded(instance)) return *std::move(error);
  return Dispatcher(std::make_unique<Parts>(instance, options));
}

Dispatcher::Dispatcher(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Dispatcher::~Dispatcher() = default;
Dispatcher::Dispatcher(Dispatcher&&) noexcept = default;
Dispatcher& Dispatcher::operator=(Dispatcher&&) noexcept = default;

std::size_t Dispatcher::num_robots() const noexcept { return parts_->robots().size(); }

std::optional<Error> Dispatcher::assign(AgentId robot, Task task) {
  return parts_->assign(robot, std::move(task));
}

std::optional<Error> Dispatcher::cancel(AgentId robot) {
  if (robot.index() >= num_robots()) return invalid("there is no " + robot_name(robot));
  Robot& one = parts_->robots()[robot.index()];
  one.tasks.clear();
  one.busy_until.reset();
  one.is_bound = false;
  return std::nullopt;
}

std::optional<Error> Dispatcher::close(VertexId from, VertexId to) {
  return parts_->roads().close(from, to);
}
std::optional<Error> Dispatcher::open(VertexId from, VertexId to) {
  return parts_->roads().open(from, to);
}

std::optional<Error> Dispatcher::report(AgentId robot, Ticks clock) {
  if (robot.index() >= num_robots()) return invalid("there is no " + robot_name(robot));
  Robot& one = parts_->robots()[robot.index()];
  if (clock < one.clock)
    return out_of_range("the clock of " + robot_name(robot) + " goes back from " +
                        std::to_string(one.clock.value()) + " to " + std::to_string(clock.value()));
  if (clock > one.limit)
    return out_of_range(robot_name(robot) + " has gone on to " + std::to_string(clock.value()) +
                        ", and was allowed to go to " + std::to_string(one.limit.value()));
  one.clock = clock;
  return std::nullopt;
}

News Dispatcher::tick(Ticks duration, const Limits& limits) {
  QUADRILLE_REQUIRE(duration >= 1, "time goes on");
  return parts_->tick(duration, limits);
}

const Course& Dispatcher::course(AgentId robot) const {
  return parts_->robots().at(robot.index()).course;
}
Ticks Dispatcher::clock(AgentId robot) const { return parts_->robots().at(robot.index()).clock; }
Ticks Dispatcher::limit(AgentId robot) const { return parts_->robots().at(robot.index()).limit; }
const execution::Precedences& Dispatcher::order() const noexcept { return parts_->order(); }
Ticks Dispatcher::now() const noexcept { return parts_->now(); }
std::size_t Dispatcher::num_tasks(AgentId robot) const {
  return parts_->robots().at(robot.index()).tasks.size();
}

}  // namespace quadrille::dispatch
