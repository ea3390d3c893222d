// SPDX-License-Identifier: MIT
#include "settle/rush.hpp"

#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {
namespace {

constexpr std::uint32_t kSeed = 0;
/// Agents that move of their own accord. Measured with 8, 32, 64, 128, 256 and all: 5,000 agents in
/// a warehouse 30,670, 19,728, 16,522, 15,645, 14,087 and 19,011 timesteps; 500 in a maze about as
/// many from 32 on.
constexpr std::size_t kMovers = 256;

}  // namespace

Rush::Rush(Instance instance, std::shared_ptr<const GoalDistances> distances,
           const ComponentNumbering& numbering, const Component& component,
           std::span<const Local> order)
    : instance_(std::move(instance)),
      distances_(std::move(distances)),
      numbering_(numbering),
      component_(component),
      random_(kSeed),
      pibt_(instance_, *distances_, random_),
      from_(instance_.num_agents()),
      next_(instance_.num_agents()) {
  for (const Local agent : order) order_.emplace_back(agent);
}

std::unique_ptr<Rush> Rush::make(const Instance& instance, const ComponentNumbering& numbering,
                                 const Component& component, std::span<const Local> places,
                                 std::span<const Local> order, LimitMonitor& limits) {
  std::vector<Agent> tasks;
  for (Local k = 0; k < places.size(); ++k)
    tasks.push_back({instance.agents()[component.agents[k]].start, component.vertices[places[k]]});
  auto own = Instance::make(instance.shared_graph(), std::move(tasks));
  QUADRILLE_REQUIRE(own.has_value(), "starts and places are vertices, all different");
  auto distances = GoalDistances::make(*own, limits);
  if (distances == nullptr) return nullptr;
  return std::unique_ptr<Rush>(
      new Rush(*std::move(own), std::move(distances), numbering, component, order));
}

void Rush::advance(pebbles::Board& board, std::size_t num_settled) {
  for (Local agent = 0; agent < from_.size(); ++agent)
    from_[agent] = component_.vertices[board.vertex_of(agent)];
  while (stays_.size() < num_settled) {
    const AgentId agent = order_[stays_.size()];
    stays_.push_back({agent, from_[agent.index()]});
  }
  const bool is_whole = pibt_.advance(from_, order_, stays_, to_, num_settled + kMovers);
  QUADRILLE_REQUIRE(is_whole, "who may stay finds a vertex");
  for (std::size_t k = 0; k < to_.size(); ++k) next_[k] = numbering_.number(to_[k]);
  board.step(next_);
  effort_ += static_cast<std::int64_t>(from_.size()) + 1;
}

}  // namespace quadrille::discrete
