// SPDX-License-Identifier: MIT
#include "primal/serial_search.hpp"

#include <algorithm>
#include <functional>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {
namespace {

constexpr std::uint32_t kFar = 0xffffffffu, kNoNode = 0xffffffffu;
/// Bits for pairs of agents and places: 32 MiB.
constexpr std::size_t kMostPairs = std::size_t{1} << 28;

/// A number for each agent at each place (splitmix64, Steele et al. 2014), so that those of an
/// arrangement, put together by exclusive or, tell arrangements apart.
std::uint64_t hash_of(std::size_t agent_and_place) {
  std::uint64_t z = (agent_and_place + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

SerialSearch::SerialSearch(StandingBodies& bodies)
    : bodies_(bodies),
      instance_(bodies.scene().instance()),
      limits_(bodies.scene().limits()),
      num_agents_(instance_.num_agents()),
      num_places_(instance_.roadmap().num_vertices() + 1),
      standing_(bodies) {
  find_distances();
  const std::size_t facts = num_agents_ * num_places_;
  limits_.check_room_for(facts * (num_agents_ + 1) / 8);
  seen_.assign(facts * (num_agents_ + 1), false);
  has_pairs_ = facts <= kMostPairs / facts / (num_agents_ + 1);
  if (has_pairs_) {
    limits_.check_room_for(facts * facts * (num_agents_ + 1) / 8);
    seen_pairs_.assign(facts * facts * (num_agents_ + 1), false);
  }
  table_.assign(1024, kNoNode);
  steps_.emplace_back();
  std::uint64_t hash = 0;
  std::uint32_t distance = 0;
  for (const AgentId i : instance_.agent_ids()) {
    const VertexId at = standing_.vertex_of(i);
    const std::size_t place = standing_.is_gone(i) ? num_places_ - 1 : at.index();
    places_.push_back(static_cast<std::uint32_t>(place));
    hash ^= hash_of(i.index() * num_places_ + place);
    if (standing_.is_gone(i)) continue;
    if (distances_[i.index()][at.index()] == kFar) state_ = State::exhausted;
    distance += distances_[i.index()][at.index()];
  }
  hashes_.push_back(hash);
  static_cast<void>(is_new(0, hash));
  if (standing_.are_all_home()) state_ = State::found;
  open_.push({0, distance, 0});
}

void SerialSearch::find_distances() {
  const Roadmap& roadmap = instance_.roadmap();
  for (const AgentId i : instance_.agent_ids()) {
    limits_.check();
    const ClassId c = instance_.class_of(i);
    std::vector<std::uint32_t> distance(roadmap.num_vertices(), kFar);
    std::vector<VertexId> queue{instance_.agent(i).goal()};
    distance[queue.front().index()] = 0;
    for (std::size_t head = 0; head < queue.size(); ++head)
      for (const EdgeId e : roadmap.in_edges(queue[head])) {
        const VertexId from = roadmap.from(e);
        if (distance[from.index()] != kFar || !bodies_.may_use(c, e)) continue;
        distance[from.index()] = distance[queue[head].index()] + 1;
        queue.push_back(from);
      }
    distances_.push_back(std::move(distance));
  }
}

void SerialSearch::grow_table() {
  table_.assign(2 * table_.size(), kNoNode);
  const std::size_t mask = table_.size() - 1;
  for (Node node = 0; node < hashes_.size(); ++node) {
    std::size_t at = hashes_[node] & mask;
    while (table_[at] != kNoNode) at = (at + 1) & mask;
    table_[at] = node;
  }
}

/// Enters the last node unless its arrangement is there already.
bool SerialSearch::is_new(Node node, std::uint64_t hash) {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = hash & mask;
  for (; table_[at] != kNoNode; at = (at + 1) & mask)
    if (hashes_[table_[at]] == hash &&
        std::equal(places_of(node), places_of(node) + num_agents_, places_of(table_[at])))
      return false;
  table_[at] = node;
  if (2 * hashes_.size() > table_.size()) grow_table();
  return true;
}

std::uint32_t SerialSearch::novelty_of(const std::uint32_t* places, std::size_t moved,
                                       std::size_t num_away) {
  const std::size_t facts = num_agents_ * num_places_;
  const std::size_t fact = moved * num_places_ + places[moved];
  std::uint32_t novelty = 2;
  if (has_pairs_) {
    effort_ += static_cast<std::int64_t>(num_agents_);
    for (std::size_t i = 0; i < num_agents_; ++i) {
      const std::size_t other = i * num_places_ + places[i];
      const std::size_t pair =
          (num_away * facts + std::min(fact, other)) * facts + std::max(fact, other);
      if (!seen_pairs_[pair]) novelty = 1;
      seen_pairs_[pair] = true;
    }
  }
  if (!seen_[num_away * facts + fact]) novelty = 0;
  seen_[num_away * facts + fact] = true;
  return novelty;
}

void SerialSearch::load(Node node) {
  for (std::size_t i = 0; i < num_agents_; ++i) {
    const std::uint32_t place = places_of(node)[i];
    const AgentId agent(i);
    if (place + 1 == num_places_)
      standing_.put(agent, standing_.vertex_of(agent), true);
    else if (standing_.is_gone(agent) || standing_.vertex_of(agent).index() != place)
      standing_.put(agent, VertexId(place));
  }
}

void SerialSearch::add(Node parent, const SerialMove& move) {
  const std::size_t moved = move.agent.index();
  const Agent& agent = instance_.agent(move.agent);
  const VertexId to = instance_.roadmap().edge(move.edge).to;
  const std::size_t place = agent.leaves && to == agent.goal() ? num_places_ - 1 : to.index();
  const auto node = static_cast<Node>(steps_.size());
  const std::uint64_t hash = hashes_[parent] ^
                             hash_of(moved * num_places_ + places_of(parent)[moved]) ^
                             hash_of(moved * num_places_ + place);
  effort_ += static_cast<std::int64_t>(num_agents_ / 4) + 5;
  places_.resize(places_.size() + num_agents_);
  std::copy_n(places_of(parent), num_agents_, places_of(node));
  places_of(node)[moved] = static_cast<std::uint32_t>(place);
  hashes_.push_back(hash);
  if (!is_new(node, hash)) {
    places_.resize(places_.size() - num_agents_);
    hashes_.pop_back();
    return;
  }
  steps_.push_back({parent, move});
  std::uint32_t distance = 0;
  std::size_t num_away = 0;
  for (std::size_t i = 0; i < num_agents_; ++i) {
    const std::uint32_t at = places_of(node)[i];
    const std::uint32_t own = at + 1 == num_places_ ? 0 : distances_[i][at];
    distance += own;
    num_away += own > 0 ? 1 : 0;
  }
  if (num_away == 0) {
    goal_ = node;
    state_ = State::found;
  }
  open_.push({novelty_of(places_of(node), moved, num_away), distance, node});
}

void SerialSearch::expand(Node node) {
  load(node);
  for (std::size_t i = 0; i < num_agents_ && state_ == State::working; ++i) {
    const AgentId agent(i);
    if (standing_.is_gone(agent)) continue;
    const ClassId c = instance_.class_of(agent);
    for (const EdgeId e : instance_.roadmap().out_edges(standing_.vertex_of(agent))) {
      ++effort_;
      const VertexId to = instance_.roadmap().to(e);
      if (distances_[i][to.index()] == kFar || !bodies_.may_use(c, e) ||
          !standing_.can_move({agent, e}, effort_))
        continue;
      add(node, {agent, e});
      if (state_ != State::working) return;
    }
  }
}

SerialSearch::State SerialSearch::advance(std::int64_t effort) {
  const std::int64_t enough = effort_ + effort;
  while (state_ == State::working && effort_ < enough) {
    limits_.check_room_for(64 * (num_agents_ + 16));
    if (open_.empty()) {
      state_ = State::exhausted;
      break;
    }
    const Node node = open_.top().node;
    open_.pop();
    expand(node);
  }
  return state_;
}

std::vector<SerialMove> SerialSearch::moves() const {
  QUADRILLE_REQUIRE(state_ == State::found, "there is a plan");
  std::vector<SerialMove> moves;
  for (Node node = goal_; node != 0; node = steps_[node].parent) moves.push_back(steps_[node].move);
  std::reverse(moves.begin(), moves.end());
  return moves;
}

}  // namespace quadrille::continuous
