// SPDX-License-Identifier: MIT
#include "quadrille/discrete/rolling_planner.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "model/timesteps.hpp"
#include "pibt/pibt.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/goal_distances.hpp"
#include "rolling/visit_order.hpp"
#include "rolling/window.hpp"
#include "rolling/window_search.hpp"

namespace quadrille::discrete {
namespace {

/// What a state of a search takes.
constexpr Effort kState = Effort::nanoseconds(60);
/// A search that has not found a path by then is given up.
constexpr std::int64_t kMostStates = 20'000;
/// Agents of a neighbourhood, at most, drawn from these; and walks to find them.
constexpr std::array<std::size_t, 4> kSizes{2, 4, 8, 16};
constexpr int kWalks = 8;

}  // namespace

class RollingPlanner::Parts {
 public:
  Parts(std::shared_ptr<const Graph> graph, std::span<const VertexId> places,
        const RollingOptions& options)
      : graph_(std::move(graph)),
        options_(options),
        random_(options.seed),
        distances_(*graph_, places.size()),
        window_(graph_->num_vertices(), places, options.window),
        search_(*graph_, window_, random_),
        pibt_(*graph_, places.size(), distances_.table(), random_, nullptr,
              Pibt::Ties::least_wanted),
        robots_(places.size()),
        order_(places.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
  }

  /// The same fleet on another graph, with nothing planned.
  [[nodiscard]] std::unique_ptr<Parts> on(std::shared_ptr<const Graph> graph) const {
    const auto here = window_.configuration(0);
    auto parts = std::make_unique<Parts>(std::move(graph), here, options_);
    parts->random_ = random_;
    parts->now_ = now_;
    parts->robots_ = robots_;
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      Robot& robot = parts->robots_[k];
      if (!robot.has_errand) continue;
      parts->distances_.set(AgentId(k), robot.goals);
      if (robot.arrival <= now_) continue;
      robot.arrival = kForever;
      parts->news_.emplace_back(k);
    }
    return parts;
  }

  void send(AgentId i, const Goals& goals, Timestep service, std::int64_t rank) {
    robots_[i.index()] = {goals,
                          true,
                          service,
                          rank,
                          kForever,
                          robots_[i.index()].num_held,
                          robots_[i.index()].held_until};
    distances_.set(i, goals);
    look_for_arrival(i);
    news_.push_back(i);
  }
  void release(AgentId i) {
    robots_[i.index()].has_errand = false;
    distances_.set_everywhere(i);
  }

  Effort plan(Effort effort, const Limits& limits) {
    LimitMonitor monitor(limits);
    while (window_.length() < options_.window) extend();
    if (effort <= Effort()) {
      news_.clear();
      return {};
    }
    const std::int64_t before = num_states_ + search_.effort();
    const auto spent = [&] { return (num_states_ + search_.effort() - before) * kState; };
    std::sort(news_.begin(), news_.end(), [this](AgentId a, AgentId b) { return is_first(a, b); });
    std::size_t num_sent = 0;
    while (num_sent < news_.size() && spent() < effort && !monitor.exhausted())
      static_cast<void>(replace({news_[num_sent++]}));
    news_.erase(news_.begin(), news_.begin() + static_cast<std::ptrdiff_t>(num_sent));
    std::size_t num_content = 0;  // in a row
    while (options_.improves && spent() < effort && num_content < robots_.size() &&
           !monitor.exhausted()) {
      const AgentId seed = next_seed();
      if (cost(seed) <= free_cost(seed)) {
        ++num_content;
        continue;
      }
      num_content = 0;
      gather(seed, kSizes[static_cast<std::size_t>(random_.below(kSizes.size()))]);
      random_.shuffle_front(chosen_, chosen_.size());
      static_cast<void>(replace(chosen_));
    }
    return spent();
  }

  void advance(std::span<const AgentId> held) {
    while (window_.length() < 1) extend();
    std::vector<bool> is_held(robots_.size(), false);
    for (const AgentId i : held) is_held[i.index()] = true;
    bool is_late = false;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& robot = robots_[i];
      robot.num_held = is_held[i] ? robot.num_held + 1 : 0;
      robot.held_until = is_held[i] ? now_ + 1 + robot.num_held : 0;
      is_late = is_late ||
                (hold(AgentId(i), 0) > 0 && window_.at(AgentId(i), 0) != window_.at(AgentId(i), 1));
    }
    if (is_late) put_off();
    window_.pop();
    ++now_;
  }

  [[nodiscard]] std::size_t num_agents() const { return robots_.size(); }
  [[nodiscard]] Timestep now() const { return now_; }
  [[nodiscard]] const Window& window() const { return window_; }
  [[nodiscard]] bool is_done(AgentId i) const {
    const Robot& robot = robots_[i.index()];
    return robot.has_errand && robot.arrival <= now_ && robot.arrival + robot.service <= now_;
  }
  [[nodiscard]] bool arrives(AgentId i) const {
    return robots_[i.index()].has_errand && robots_[i.index()].arrival != kForever;
  }
  [[nodiscard]] Timestep cost(AgentId i) const {
    const Robot& robot = robots_[i.index()];
    if (!robot.has_errand) return 0;
    if (robot.arrival != kForever) return std::max(0, robot.arrival - now_);
    return window_.length() + distances_.table()(i, window_.at(i, window_.length()));
  }
  [[nodiscard]] Timestep free_cost(AgentId i) const {
    const Robot& robot = robots_[i.index()];
    if (!robot.has_errand || robot.arrival <= now_) return 0;
    return distances_.table()(i, window_.at(i, 0));
  }

 private:
  struct Robot {
    Goals goals;
    bool has_errand = false;
    Timestep service = 0;
    std::int64_t rank = 0;
    Timestep arrival = kForever;  // As planned; absolute. kForever: not in the window.
    Timestep num_held = 0;        // Timesteps in a row.
    Timestep held_until = 0;      // Absolute, as far as one can guess.
  };

  /// For how long the agent has to stay where it is at a time from now, if it is there then because
  /// it has arrived or is held up.
  [[nodiscard]] Timestep hold(AgentId i, Timestep t) const {
    const Robot& robot = robots_[i.index()];
    Timestep until = robot.held_until;
    if (robot.has_errand && robot.arrival <= now_ + t)
      until = std::max(until, robot.arrival + robot.service);
    return std::max(0, until - (now_ + t));
  }
  [[nodiscard]] bool is_first(AgentId a, AgentId b) const {
    return std::pair(robots_[a.index()].rank, a) < std::pair(robots_[b.index()].rank, b);
  }

  /// By a timestep: those that have not arrived by then choose first, by rank.
  void extend() {
    const Timestep end = window_.length();
    std::vector<AgentId> priority, others;
    std::vector<Pibt::Order> stays;
    for (std::size_t k = 0; k < robots_.size(); ++k) {
      const AgentId i(k);
      const Robot& robot = robots_[k];
      (robot.has_errand && robot.arrival == kForever ? priority : others).push_back(i);
      if (hold(i, end) > 0) stays.push_back({i, window_.at(i, end)});
    }
    std::sort(priority.begin(), priority.end(),
              [this](AgentId a, AgentId b) { return is_first(a, b); });
    const std::size_t num_choosing = priority.size();
    priority.insert(priority.end(), others.begin(), others.end());
    const auto last = window_.configuration(end);
    const std::vector<VertexId> from(last.begin(), last.end());
    const bool is_whole = pibt_.advance(from, priority, stays, to_, num_choosing);
    QUADRILLE_REQUIRE(is_whole, "everybody may stay");
    window_.push(to_);
    for (const AgentId i : std::span(priority).first(num_choosing))
      if (robots_[i.index()].goals.contains(to_[i.index()]))
        robots_[i.index()].arrival = now_ + end + 1;
  }

  void look_for_arrival(AgentId i) {
    Robot& robot = robots_[i.index()];
    robot.arrival = kForever;
    for (Timestep t = 0; t <= window_.length(); ++t)
      if (robot.goals.contains(window_.at(i, t))) {
        robot.arrival = now_ + t;
        return;
      }
  }

  /// What is planned happens in the same order, without those that are held.
  void put_off() {
    std::vector<Path> paths;
    std::vector<Timestep> arrivals;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      paths.push_back(window_.path(AgentId(i)));
      // Those to come are found out on the way.
      arrivals.push_back(robots_[i].arrival <= now_ ? robots_[i].arrival : kForever);
    }
    const auto is_held = [&](AgentId i, VertexId at, Timestep t) {
      const Robot& robot = robots_[i.index()];
      Timestep& arrival = arrivals[i.index()];
      if (now_ + t < robot.held_until) return true;
      if (!robot.has_errand) return false;
      if (arrival == kForever && robot.goals.contains(at)) arrival = now_ + t;
      return arrival != kForever && now_ + t < arrival + robot.service;
    };
    paths = retimed(graph_->num_vertices(), paths, is_held);
    for (std::size_t i = 0; i < robots_.size(); ++i) window_.take_out(AgentId(i));
    for (std::size_t i = 0; i < robots_.size(); ++i) window_.put(AgentId(i), paths[i]);
    for (std::size_t i = 0; i < robots_.size(); ++i)
      if (robots_[i].has_errand && robots_[i].arrival > now_) look_for_arrival(AgentId(i));
  }

  AgentId next_seed() {
    if (next_ == 0) random_.shuffle_front(order_, order_.size());
    const AgentId seed(order_[next_]);
    next_ = (next_ + 1) % order_.size();
    return seed;
  }

  void choose(std::uint32_t agent) {
    if (agent == Window::kNobody) return;
    if (std::find(chosen_.begin(), chosen_.end(), AgentId(agent)) == chosen_.end())
      chosen_.emplace_back(agent);
  }
  /// The seed, and those that are met on ways that would be better.
  void gather(AgentId seed, std::size_t size) {
    chosen_.assign(1, seed);
    AgentId walker = seed;
    for (int k = 0; k < kWalks && chosen_.size() < size; ++k) {
      walk(walker, size);
      walker = chosen_[static_cast<std::size_t>(random_.below(chosen_.size()))];
    }
  }
  /// Leaves the agent's path at a random time, and could still arrive earlier than it does.
  void walk(AgentId i, std::size_t size) {
    const Timestep cost = this->cost(i), end = window_.length();
    const auto row = distances_.table().row(i);
    if (cost == 0) return;
    auto t = static_cast<Timestep>(random_.below(static_cast<std::uint64_t>(std::min(cost, end))));
    VertexId at = window_.at(i, t);
    for (; t < end && chosen_.size() < size; ++t) {
      ways_.clear();
      const auto add = [&](VertexId v) {
        if (t + 1 + row[v] < cost) ways_.push_back(v);
      };
      for (const VertexId v : graph_->neighbours(at)) add(v);
      add(at);
      if (ways_.empty()) return;
      const VertexId to = ways_[static_cast<std::size_t>(random_.below(ways_.size()))];
      choose(window_.who(to, t + 1));
      const std::uint32_t ahead = window_.who(to, t);
      if (ahead != Window::kNobody && ahead == window_.who(at, t + 1)) choose(ahead);
      at = to;
      ++num_states_;
    }
  }

  /// Other paths for these agents, in this order, if they cost no more in sum.
  bool replace(const std::vector<AgentId>& agents) {
    old_.clear();
    Timestep most = 0;  // what is left
    for (const AgentId i : agents) {
      most += cost(i) - free_cost(i);
      old_.push_back({window_.path(i), cost(i), {}});
      window_.take_out(i);
      num_states_ += window_.length() / 2;
    }
    std::size_t num_new = 0;
    for (const AgentId i : agents) {
      const Timestep free = free_cost(i);
      const WindowSearch::Found* const found = find(i, free + most);
      if (found == nullptr) break;
      most -= found->cost - free;
      window_.put(i, found->path);
      old_[num_new++].arrival = found->arrival;
    }
    if (num_new == agents.size()) {
      for (std::size_t k = 0; k < agents.size(); ++k) {
        Robot& robot = robots_[agents[k].index()];
        if (!robot.has_errand || robot.arrival <= now_) continue;
        robot.arrival = old_[k].arrival ? now_ + *old_[k].arrival : kForever;
      }
      return true;
    }
    for (std::size_t k = 0; k < num_new; ++k) window_.take_out(agents[k]);
    for (std::size_t k = 0; k < agents.size(); ++k) window_.put(agents[k], old_[k].path);
    return false;
  }
  const WindowSearch::Found* find(AgentId i, Timestep most) {
    const Robot& robot = robots_[i.index()];
    const bool has_to_go = robot.has_errand && robot.arrival > now_;
    const Errand errand{has_to_go ? &robot.goals : nullptr, robot.service, hold(i, 0)};
    return search_.find(window_.at(i, 0), errand, distances_.table().row(i), most, kMostStates);
  }

  const std::shared_ptr<const Graph> graph_;
  const RollingOptions options_;
  Random random_;
  ChangingGoalDistances distances_;
  Window window_;
  WindowSearch search_;
  Pibt pibt_;
  std::vector<Robot> robots_;
  Timestep now_ = 0;
  std::int64_t num_states_ = 0;       // Of work other than that of searches.
  std::vector<AgentId> news_;         // Sent somewhere since the last plan.
  std::vector<std::uint32_t> order_;  // Of seeds.
  std::size_t next_ = 0;

  std::vector<VertexId> to_, ways_;
  std::vector<AgentId> chosen_;
  std::vector<WindowSearch::Found> old_;
};

RollingPlanner::RollingPlanner(std::shared_ptr<const Graph> graph, std::span<const VertexId> places,
                               const RollingOptions& options) {
  QUADRILLE_REQUIRE(graph != nullptr && options.window >= 1, "a graph and a window");
  parts_ = std::make_unique<Parts>(std::move(graph), places, options);
}
RollingPlanner::~RollingPlanner() = default;
RollingPlanner::RollingPlanner(RollingPlanner&&) noexcept = default;
RollingPlanner& RollingPlanner::operator=(RollingPlanner&&) noexcept = default;

void RollingPlanner::send(AgentId agent, const Goals& goals, Timestep service, std::int64_t rank) {
  QUADRILLE_REQUIRE(agent.index() < num_agents() && service >= 0, "an agent, and a time");
  parts_->send(agent, goals, service, rank);
}
void RollingPlanner::release(AgentId agent) { parts_->release(agent); }
void RollingPlanner::set_graph(std::shared_ptr<const Graph> graph) {
  QUADRILLE_REQUIRE(graph != nullptr, "a graph");
  parts_ = parts_->on(std::move(graph));
}
Effort RollingPlanner::plan(Effort effort, const Limits& limits) {
  return parts_->plan(effort, limits);
}
void RollingPlanner::advance(std::span<const AgentId> held) { parts_->advance(held); }

std::size_t RollingPlanner::num_agents() const noexcept { return parts_->num_agents(); }
Timestep RollingPlanner::now() const noexcept { return parts_->now(); }
VertexId RollingPlanner::place(AgentId agent) const { return parts_->window().at(agent, 0); }
Path RollingPlanner::path(AgentId agent) const { return parts_->window().path(agent); }
bool RollingPlanner::is_done(AgentId agent) const { return parts_->is_done(agent); }
bool RollingPlanner::arrives(AgentId agent) const { return parts_->arrives(agent); }
Timestep RollingPlanner::cost(AgentId agent) const { return parts_->cost(agent); }
Timestep RollingPlanner::free_cost(AgentId agent) const { return parts_->free_cost(agent); }

}  // namespace quadrille::discrete
