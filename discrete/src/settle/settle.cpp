// SPDX-License-Identifier: MIT
#include "settle/settle.hpp"

#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/pebbles/settling.hpp"
#include "settle/local_graph.hpp"
#include "settle/rush.hpp"
#include "settle/shift_paths.hpp"

namespace quadrille::discrete {
namespace {

using State = Settling::State;

/// The agents of one component.
class ComponentSettling {
 public:
  /// The first two outlive the object.
  ComponentSettling(const Instance& instance, const ComponentNumbering& numbering,
                    Component component, std::vector<Local> starts, std::vector<Local> goals)
      : component_(std::move(component)),
        settling_(
            local_graph(component_, numbering), std::move(starts), std::move(goals),
            pebbles::Rotations::allowed,
            [&instance, &numbering, this](std::span<const Local> places,
                                          std::span<const Local> order, LimitMonitor& limits) {
              return Rush::make(instance, numbering, component_, places, order, limits);
            }) {}
  ComponentSettling(const ComponentSettling&) = delete;
  ComponentSettling& operator=(const ComponentSettling&) = delete;

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
    return write_paths(settling_.shifts(), settling_.starts(), component_.agents,
                       component_.vertices, plan, limits);
  }

 private:
  const Component component_;
  pebbles::Settling settling_;
};

}  // namespace

class Settling::Impl {
 public:
  explicit Impl(const Instance& instance)
      : num_agents_(instance.num_agents()), numbering_(instance.graph()) {
    std::vector<Component> components;
    for (const AgentId agent : instance.agent_ids()) {
      const VertexId start = instance.agents()[agent].start, goal = instance.agents()[agent].goal();
      if (numbering_.component_of(start) == kNoLocal)
        components.push_back(numbering_.explore(start));
      if (numbering_.component_of(goal) != numbering_.component_of(start)) {
        state_ = State::given_up;
        return;
      }
      components[numbering_.component_of(start)].agents.push_back(agent);
    }
    for (Component& component : components) {
      std::vector<Local> starts, goals;
      for (const AgentId agent : component.agents) {
        starts.push_back(numbering_.number(instance.agents()[agent].start));
        goals.push_back(numbering_.number(instance.agents()[agent].goal()));
      }
      parts_.emplace_back(instance, numbering_, std::move(component), std::move(starts),
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
  ComponentNumbering numbering_;
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
