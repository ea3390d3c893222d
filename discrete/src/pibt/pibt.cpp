// SPDX-License-Identifier: MIT
#include "pibt/pibt.hpp"

#include <algorithm>
#include <tuple>

namespace quadrille::discrete {

Pibt::Pibt(const Instance& instance, const GoalDistances& distances, Random& random,
           const Guidance* guide, Ties ties)
    : Pibt(instance.graph(), instance.num_agents(), distances, random, guide, ties) {}

Pibt::Pibt(const Graph& graph, std::size_t num_agents, const GoalDistances& distances,
           Random& random, const Guidance* guide, Ties ties)
    : graph_(graph),
      distances_(distances),
      random_(random),
      guide_(guide),
      ties_(ties),
      decided_(num_agents, 0),
      occupant_(graph_.num_vertices(), kNobody),
      claimer_(graph_.num_vertices(), kNobody) {}

bool Pibt::advance(std::span<const VertexId> from, std::span<const AgentId> priority,
                   std::span<const Order> orders, std::vector<VertexId>& to,
                   std::size_t num_choosing) {
  from_ = from;
  to_ = &to;
  to.assign(from.begin(), from.end());
  for (const AgentId agent : priority) occupant_[from[agent.index()]] = agent.value();
  bool complete = obey(orders);
  num_choosing = std::min(num_choosing, priority.size());
  for (std::size_t k = 0; complete && k < num_choosing; ++k)
    complete = decided_[priority[k].index()] != 0 || place(priority[k]);
  reset();
  return complete;
}

bool Pibt::obey(std::span<const Order> orders) {
  for (const auto& [agent, to] : orders) {
    if (claimer_[to] != kNobody) return false;
    const std::uint32_t other = occupant_[to];
    const VertexId here = from_[agent.index()];
    if (other != kNobody && other != agent.value() && claimer_[here] == other) return false;
    move(agent, to);
  }
  return true;
}

void Pibt::move(AgentId agent, VertexId to) {
  claimer_[to] = agent.value();
  (*to_)[agent.index()] = to;
  decided_[agent.index()] = 1;
}

/// Finds a vertex for the agent and for all whom it pushes. PIBT is usually told as a recursion
/// over the pushed agents; here they are on a stack, since a queue of pushed agents can be long.
/// When the last one finds a free vertex, all have one. When one finds none it stays, and its
/// pusher tries the next candidate. Only the first agent can fail: the vertices of the others are
/// claimed by their pushers, so nobody else can take them away.
bool Pibt::place(AgentId root) {
  push_frame(root);
  for (;;) {
    Frame& frame = stack_.back();
    const AgentId agent = frame.agent;
    const VertexId here = from_[agent.index()];
    if (frame.next == candidates_.size()) {
      move(agent, here);
      candidates_.resize(frame.first);
      stack_.pop_back();
      if (stack_.empty()) return false;
      continue;
    }
    const VertexId to = candidates_[frame.next++].vertex;
    if (claimer_[to] != kNobody) continue;
    const std::uint32_t other = occupant_[to];
    const bool is_pushed = other != kNobody && other != agent.value();
    if (is_pushed && decided_[other] != 0 && (*to_)[other] == here) continue;
    move(agent, to);
    if (is_pushed && decided_[other] == 0) {
      push_frame(AgentId(other));
      continue;
    }
    for (; !stack_.empty(); stack_.pop_back()) pull_partner(stack_.back());
    candidates_.clear();
    return true;
  }
}

void Pibt::push_frame(AgentId agent) {
  const VertexId here = from_[agent.index()];
  const std::size_t first = candidates_.size();
  const auto guided = guide_ != nullptr ? guide_->next(agent, here) : std::nullopt;
  const auto add = [&](VertexId v) {
    const Timestep distance = v == guided ? -1 : distances_(agent, v);
    const std::uint32_t wanted = ties_ == Ties::random ? 0 : num_wanting(v, here);
    candidates_.push_back({distance, wanted, random_.below(1U << 30), v});
  };
  for (const VertexId v : graph_.neighbours(here)) add(v);
  add(here);
  const auto begin = candidates_.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.num_wanting, a.tie, a.vertex) <
           std::tie(b.distance, b.num_wanting, b.tie, b.vertex);
  });
  const std::uint32_t partner = swap_partner(agent, begin->vertex);
  // To let the partner pass the agent walks away from its goal, and the partner follows.
  if (partner != kNobody) std::reverse(begin, candidates_.end());
  stack_.push_back({agent, first, first, partner});
}

/// Of the agents around a vertex: for how many is `to` nearer to the goal than where they are?
std::uint32_t Pibt::num_wanting(VertexId to, VertexId centre) const {
  std::uint32_t count = 0;
  for (const VertexId v : graph_.neighbours(centre)) {
    const std::uint32_t other = occupant_[v];
    if (other == kNobody || v == to) continue;
    const auto distances = distances_.row(AgentId(other));
    if (distances[to] < distances[v]) ++count;
  }
  return count;
}

/// The partner of a swap follows if the agent could make its first choice.
void Pibt::pull_partner(const Frame& frame) {
  if (frame.partner == kNobody || frame.next != frame.first + 1) return;
  const VertexId here = from_[frame.agent.index()];
  if (decided_[frame.partner] == 0 && claimer_[here] == kNobody) move(AgentId(frame.partner), here);
}

/// The agent that has to change places with `agent`, which would like to go to `best`: the one that
/// is there, or one beside the agent for which it has to make room by going on to `best` and back.
std::uint32_t Pibt::swap_partner(AgentId agent, VertexId best) const {
  const VertexId here = from_[agent.index()];
  if (best == here) return kNobody;
  const std::uint32_t ahead = occupant_[best];
  if (ahead != kNobody && decided_[ahead] == 0 && has_to_swap(agent, AgentId(ahead), here, best) &&
      can_swap(best, here))
    return ahead;
  for (const VertexId v : graph_.neighbours(here)) {
    const std::uint32_t beside = occupant_[v];
    if (beside == kNobody || v == best) continue;
    if (has_to_swap(AgentId(beside), agent, here, best) && can_swap(best, here)) return beside;
  }
  return kNobody;
}

/// The ways on from `at` when one comes from `behind`. A dead end that an agent occupies for good
/// is none.
Pibt::Continuation Pibt::continuation(VertexId at, VertexId behind) const {
  Continuation result;
  for (const VertexId v : graph_.neighbours(at)) {
    if (v == behind) continue;
    const std::uint32_t other = occupant_[v];
    if (other != kNobody && graph_.neighbours(v).size() == 1 && distances_(AgentId(other), v) == 0)
      continue;
    ++result.ways;
    result.vertex = v;
  }
  return result;
}

/// Follows the only way on from where the puller is: will the pusher, pushing the puller along it,
/// get to a place where the two want to pass each other? Ends, since the distance of the pusher
/// decreases.
bool Pibt::has_to_swap(AgentId pusher, AgentId puller, VertexId pusher_at,
                       VertexId puller_at) const {
  while (distances_(pusher, puller_at) < distances_(pusher, pusher_at)) {
    const Continuation next = continuation(puller_at, pusher_at);
    if (next.ways >= 2) return false;
    if (next.ways == 0) break;
    pusher_at = puller_at;
    puller_at = next.vertex;
  }
  return distances_(puller, pusher_at) < distances_(puller, puller_at) &&
         (distances_(pusher, pusher_at) == 0 ||
          distances_(pusher, puller_at) < distances_(pusher, pusher_at));
}

/// Walking from `pusher_at` over `puller_at` on, is there a place with a side branch before the way
/// ends or comes back? Vertices with one way on form a simple path or a cycle, so this ends.
bool Pibt::can_swap(VertexId pusher_at, VertexId puller_at) const {
  const VertexId origin = pusher_at;
  while (puller_at != origin) {
    const Continuation next = continuation(puller_at, pusher_at);
    if (next.ways >= 2) return true;
    if (next.ways == 0) return false;
    pusher_at = puller_at;
    puller_at = next.vertex;
  }
  return false;
}

void Pibt::reset() {
  for (std::size_t i = 0; i < from_.size(); ++i) {
    occupant_[from_[i]] = kNobody;
    if (decided_[i] != 0) claimer_[(*to_)[i]] = kNobody;
    decided_[i] = 0;
  }
  stack_.clear();
  candidates_.clear();
}

}  // namespace quadrille::discrete
