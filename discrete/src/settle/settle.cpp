// SPDX-License-Identifier: MIT
#include "settle/settle.hpp"

#include <deque>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/pebbles/settling.hpp"
#include "quadrille/pebbles/shorten.hpp"
#include "settle/local_graph.hpp"

namespace quadrille::discrete {
namespace {

using pebbles::earliest_times;
using State = Settling::State;

/// The agents of one component.
class ComponentSettling {
 public:
  ComponentSettling(const Component& component, const ComponentNumbering& numbering,
                    std::vector<Local> starts, std::vector<Local> goals)
      : agents_(component.agents),
        vertices_(component.vertices),
        settling_(local_graph(component, numbering), std::move(starts), std::move(goals)) {}

  State step(LimitMonitor& limits) {
    switch (settling_.step(limits)) {
      case pebbles::Settling::State::working:
        return State::working;
      case pebbles::Settling::State::found:
        return State::found;
      case pebbles::Settling::State::given_up:
        break;
    }
    return State::given_up;
  }
  [[nodiscard]] std::int64_t effort() const { return settling_.effort(); }

  /// Writes the paths of its agents.
  [[nodiscard]] bool write(Plan& plan, LimitMonitor& limits) const {
    const auto& shifts = settling_.shifts();
    const auto& starts = settling_.starts();
    const std::vector<Timestep> times =
        earliest_times(shifts, starts.size(), settling_.graph().size());
    std::vector<Timestep> arrivals(starts.size(), 0);
    for (std::size_t k = 0; k < shifts.size(); ++k) arrivals[shifts[k].agent] = times[k];
    std::size_t size = 0;
    for (const Timestep arrival : arrivals) size += static_cast<std::size_t>(arrival) + 1;
    if (!limits.has_room_for(size * sizeof(VertexId))) return false;
    for (Local agent = 0; agent < starts.size(); ++agent) {
      Path& path = plan.paths[agents_[agent]];
      path.reserve(static_cast<std::size_t>(arrivals[agent]) + 1);
      path.assign(1, vertices_[starts[agent]]);
    }
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      Path& path = plan.paths[agents_[shifts[k].agent]];
      path.resize(static_cast<std::size_t>(times[k]), path.back());
      path.push_back(vertices_[shifts[k].to]);
    }
    return true;
  }

 private:
  const std::vector<AgentId> agents_;
  const std::vector<VertexId> vertices_;
  pebbles::Settling settling_;
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
      parts_.emplace_back(component, numbering, std::move(starts), std::move(goals));
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
