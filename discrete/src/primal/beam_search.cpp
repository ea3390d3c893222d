// SPDX-License-Identifier: MIT
#include "primal/beam_search.hpp"

#include <algorithm>
#include <utility>

#include "primal/configuration.hpp"

namespace quadrille::discrete {
namespace {

/// Layers after which a round is given up, for each timestep of the longest shortest path.
constexpr Timestep kLayersPerTimestep = 8, kLeastLayers = 32;

Timestep farthest(const Instance& instance, const GoalDistances& distances) {
  Timestep most = 0;
  for (const AgentId i : instance.agent_ids())
    most = std::max(most, distances(i, instance.agents()[i].start));
  return most;
}

}  // namespace

bool BeamSearch::is_worth_trying(const Instance& instance, const GoalDistances& distances) {
  const auto width = static_cast<std::int64_t>(kFirstWidth * kSuccessors);
  // A plan takes about twice as many timesteps as the longest path.
  const std::int64_t round = width * 2 * farthest(instance, distances) *
                             static_cast<std::int64_t>(instance.num_agents() + 1);
  return round <= kMostEffort;
}

BeamSearch::BeamSearch(const Instance& instance, std::shared_ptr<const GoalDistances> distances,
                       std::uint32_t seed)
    : instance_(instance),
      distances_(std::move(distances)),
      num_agents_(instance.num_agents()),
      random_(seed),
      pibt_(instance, *distances_, random_),
      draws_(num_agents_) {
  for (const AgentId i : instance.agent_ids()) priority_.push_back(i);
  begin_round();
}

void BeamSearch::begin_round() {
  has_found_ = was_cut_ = is_cheaper_ = false;
  depth_ = 0;
  configurations_.clear();
  for (const Agent& agent : instance_.agents()) configurations_.push_back(agent.start);
  parents_.assign(1, kNone);
  layer_next_ = 0;
  seen_.clear();
  seen_.insert(key_of(configuration(0)));
}

void BeamSearch::advance(std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ > INT64_MAX - effort ? INT64_MAX : effort_ + effort;
  while (!is_over() && effort_ < enough && !limits.exhausted()) {
    if (layer_next_ < parents_.size())
      expand(layer_next_++);
    else
      end_layer();
  }
}

void BeamSearch::expand(NodeIndex node) {
  // The nodes do not move while a layer is expanded.
  const std::span<const VertexId> from = configuration(node);
  for (std::size_t k = 0; k < kSuccessors; ++k) {
    set_priorities(from);
    static_cast<void>(pibt_.advance(from, priority_, {}, successor_));
    if (seen_.insert(key_of(successor_)).second) consider(node);
  }
  effort_ += static_cast<std::int64_t>(kSuccessors * (num_agents_ + 1));
}

/// Who is at its goal comes last.
void BeamSearch::set_priorities(std::span<const VertexId> configuration) {
  constexpr std::uint64_t kLast = std::uint64_t{1} << 32;
  for (const AgentId i : instance_.agent_ids())
    draws_[i.index()] = random_.below(kLast) +
                        (configuration[i.index()] == instance_.agents()[i].goal() ? kLast : 0);
  std::sort(priority_.begin(), priority_.end(), [&](AgentId a, AgentId b) {
    const auto draw_a = draws_[a.index()], draw_b = draws_[b.index()];
    return draw_a != draw_b ? draw_a < draw_b : a < b;
  });
}

void BeamSearch::consider(NodeIndex parent) {
  Candidate candidate{0, 0, parent, configurations_of_next_.size()};
  for (const AgentId i : instance_.agent_ids())
    if (const Timestep way = (*distances_)(i, successor_[i.index()]); way > 0) {
      candidate.left += way;
      candidate.least += depth_ + 1 + way;
    }
  if (candidate.left == 0)
    offer(parent);
  else if (!plan_ || candidate.least < cost_) {
    configurations_of_next_.insert(configurations_of_next_.end(), successor_.begin(),
                                   successor_.end());
    next_.push_back(candidate);
  }
}

/// The plan that ends with `successor_`.
void BeamSearch::offer(NodeIndex parent) {
  has_found_ = true;
  Plan plan;
  for (const AgentId i : instance_.agent_ids()) {
    Path path{successor_[i.index()]};
    for (NodeIndex node = parent; node != kNone; node = parents_[node])
      path.push_back(configuration(node)[i.index()]);
    std::reverse(path.begin(), path.end());
    plan.paths.push_back(std::move(path));
  }
  trim(plan);
  const Cost cost = plan.cost(Objective::sum_of_costs);
  if (plan_ && cost >= cost_) return;
  plan_ = std::move(plan);
  cost_ = cost;
  is_cheaper_ = true;
}

/// Begins the next layer, or the next round.
void BeamSearch::end_layer() {
  ++depth_;
  ++effort_;
  const Timestep most =
      std::max(kLeastLayers, kLayersPerTimestep * farthest(instance_, *distances_));
  const bool is_end = has_found_ || next_.empty() || depth_ >= most;
  if (is_end) {
    is_over_ = !was_cut_ || (plan_ && !is_cheaper_);
    width_ *= 2;
    begin_round();
  } else {
    const std::size_t size = std::min(width_, next_.size());
    was_cut_ = was_cut_ || size < next_.size();
    std::stable_sort(next_.begin(), next_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.left < b.left; });
    layer_next_ = parents_.size();
    for (std::size_t k = 0; k < size; ++k) {
      const auto first = configurations_of_next_.begin() + static_cast<std::ptrdiff_t>(next_[k].at);
      configurations_.insert(configurations_.end(), first,
                             first + static_cast<std::ptrdiff_t>(num_agents_));
      parents_.push_back(next_[k].parent);
    }
  }
  next_.clear();
  configurations_of_next_.clear();
}

}  // namespace quadrille::discrete
