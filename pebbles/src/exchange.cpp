// SPDX-License-Identifier: MIT
#include "quadrille/pebbles/exchange.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "quadrille/core/contract.hpp"

namespace quadrille::pebbles {

Exchanger::Exchanger(const LocalGraph& graph, Board& board, Rotations rotations)
    : graph_(graph),
      board_(board),
      rotations_(rotations),
      kept_(graph.size()),
      seen_(graph.size()),
      on_cycle_(graph.size()),
      parent_(graph.size(), kNoLocal) {}

// ---- free vertices ------------------------------------------------------------------------------

/// From a vertex that is free, along the parents: who is on the way moves up.
void Exchanger::shift_along(Local hole) {
  for (Local v = parent_[hole]; v != kNoLocal; v = parent_[v]) {
    if (board_.is_free(v)) continue;
    const Local agent = board_.agent_at(v);
    // Past vertices that stay free. Their parents lead away from the hole.
    std::vector<Local> way;
    for (Local w = hole; w != v; w = parent_[w]) way.push_back(w);
    for (std::size_t k = way.size(); k-- > 0;) board_.move(agent, way[k]);
    effort_ += static_cast<std::int64_t>(way.size());
    hole = v;
  }
}

bool Exchanger::free(Local v, std::span<const Local> blocked, const Marks* kept,
                     std::span<const Local> rank, Local end) {
  if (board_.is_free(v)) return true;
  seen_.clear();
  for (const Local b : blocked) seen_.add(b);
  if (seen_.has(v)) return false;
  seen_.add(v);
  parent_[v] = kNoLocal;
  queue_.assign(1, v);
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const Local at = queue_[head];
    ++effort_;
    if (board_.is_free(at) && (kept == nullptr || !kept->has(at))) {
      shift_along(at);
      return true;
    }
    for (const Local w : graph_.neighbours(at)) {
      if (seen_.has(w) || (!rank.empty() && rank[w] >= end)) continue;
      seen_.add(w);
      parent_[w] = at;
      queue_.push_back(w);
    }
  }
  return false;
}

// ---- cycles -------------------------------------------------------------------------------------

/// A shortest cycle that leads from b to a along their edge: a is its first vertex, b its last one.
/// Requires that the edge is no bridge.
std::vector<Local> Exchanger::cycle_through(Local a, Local b) {
  seen_.clear();
  seen_.add(b);
  parent_[b] = kNoLocal;
  queue_.assign(1, b);
  for (std::size_t head = 0; !seen_.has(a); ++head) {
    QUADRILLE_REQUIRE(head < queue_.size(), "the edge is on a cycle");
    const Local at = queue_[head];
    ++effort_;
    for (const Local w : graph_.neighbours(at)) {
      if (seen_.has(w) || (at == b && w == a)) continue;
      seen_.add(w);
      parent_[w] = at;
      queue_.push_back(w);
    }
  }
  std::vector<Local> cycle;
  for (Local v = a; v != kNoLocal; v = parent_[v]) cycle.push_back(v);
  return cycle;
}

/// Where nothing rotates: makes room on the cycle, so that it can be turned. Nobody enters or
/// leaves a vertex of `blocked`.
bool Exchanger::free_on_cycle(const std::vector<Local>& cycle, std::span<const Local> blocked) {
  if (rotations_ == Rotations::allowed) return true;
  if (std::any_of(cycle.begin(), cycle.end(), [&](Local v) { return board_.is_free(v); }))
    return true;
  return std::any_of(cycle.begin(), cycle.end(),
                     [&](Local v) { return free(v, blocked, nullptr); });
}

/// What is on each vertex of the cycle, nobody included, goes on to the next one, or back.
void Exchanger::turn(const std::vector<Local>& cycle, bool forwards) {
  std::vector<Local> way = cycle;
  if (!forwards) std::reverse(way.begin(), way.end());
  const std::size_t size = way.size();
  effort_ += static_cast<std::int64_t>(size);
  const auto hole =
      std::find_if(way.begin(), way.end(), [&](Local v) { return board_.is_free(v); });
  if (hole == way.end()) {
    board_.rotate(way);
    return;
  }
  const auto at = static_cast<std::size_t>(hole - way.begin());
  for (std::size_t k = 1; k < size; ++k) {
    const Local from = way[(at + size - k) % size], to = way[(at + size - k + 1) % size];
    if (!board_.is_free(from)) board_.move_from(from, to);
  }
}

void Exchanger::turn_until(const std::vector<Local>& cycle, std::size_t from, std::size_t to) {
  const std::size_t forwards = (to + cycle.size() - from) % cycle.size();
  const bool is_short = 2 * forwards <= cycle.size();
  for (std::size_t k = is_short ? forwards : cycle.size() - forwards; k > 0; --k)
    turn(cycle, is_short);
}

/// The nearest free vertex that is not on the cycle; parents lead from it to the cycle.
std::optional<Local> Exchanger::nearest_free_outside(const std::vector<Local>& cycle) {
  seen_.clear();
  queue_ = cycle;
  for (const Local v : cycle) {
    seen_.add(v);
    parent_[v] = kNoLocal;
  }
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const Local at = queue_[head];
    ++effort_;
    if (head >= cycle.size() && board_.is_free(at)) return at;
    for (const Local w : graph_.neighbours(at)) {
      if (seen_.has(w)) continue;
      seen_.add(w);
      parent_[w] = at;
      queue_.push_back(w);
    }
  }
  return std::nullopt;
}

/// Makes a vertex `outside` free that is beside the vertex `exit` of the cycle. Nobody leaves the
/// cycle, and who is behind whom on it stays so, but for one agent that may come in where nobody
/// was.
bool Exchanger::free_beside_cycle(const std::vector<Local>& cycle, Local& exit, Local& outside) {
  if (const auto hole = nearest_free_outside(cycle)) {
    outside = *hole;
    while (!on_cycle_.has(parent_[outside])) outside = parent_[outside];
    exit = parent_[outside];
    parent_[outside] = kNoLocal;
    shift_along(*hole);
    return true;
  }
  const auto leads_out = [&](Local v) {
    const auto near = graph_.neighbours(v);
    return std::find_if(near.begin(), near.end(), [&](Local w) { return !on_cycle_.has(w); });
  };
  const auto from = std::find_if(cycle.begin(), cycle.end(), [&](Local v) {
    return leads_out(v) != graph_.neighbours(v).end();
  });
  const auto hole =
      std::find_if(cycle.begin(), cycle.end(), [&](Local v) { return board_.is_free(v); });
  if (from == cycle.end() || hole == cycle.end()) return false;
  exit = *from;
  outside = *leads_out(exit);
  turn_until(cycle, static_cast<std::size_t>(hole - cycle.begin()),
             static_cast<std::size_t>(from - cycle.begin()));
  board_.move_from(outside, exit);
  return true;
}

/// One leaves the cycle, the other one passes, the first one comes back.
bool Exchanger::exchange_on_cycle(Local a, Local b) {
  const std::size_t first = board_.shifts().size();
  const std::vector<Local> cycle = cycle_through(board_.vertex_of(a), board_.vertex_of(b));
  on_cycle_.clear();
  for (const Local v : cycle) on_cycle_.add(v);
  Local exit = kNoLocal, outside = kNoLocal;
  if (!free_beside_cycle(cycle, exit, outside) ||
      !free_on_cycle(cycle, std::array{outside, board_.vertex_of(a), board_.vertex_of(b)})) {
    board_.undo_to(first);
    return false;
  }
  const auto place = [&](Local v) {
    return static_cast<std::size_t>(std::find(cycle.begin(), cycle.end(), v) - cycle.begin());
  };
  turn_until(cycle, place(board_.vertex_of(a)), place(exit));
  const std::size_t last = board_.shifts().size();
  board_.move(a, outside);
  turn(cycle, true);
  board_.move(b, cycle[(place(exit) + 1) % cycle.size()]);
  board_.move(a, exit);
  turn(cycle, false);
  board_.retrace(first, last, a, b);
  return true;
}

// ---- bridges ------------------------------------------------------------------------------------

void Exchanger::swap_at_fork(Local lead, Local rear, Local side, Local other_side) {
  const Local fork = board_.vertex_of(lead), stem = board_.vertex_of(rear);
  board_.move(lead, side);
  board_.move(rear, fork);
  board_.move(rear, other_side);
  board_.move(lead, fork);
  board_.move(lead, stem);
  board_.move(rear, fork);
}

/// Brings the lead from the door to the next vertex of a cycle.
bool Exchanger::turn_into_cycle(Local next, Local door, Local rear) {
  const std::vector<Local> cycle = cycle_through(next, door);
  if (!free_on_cycle(cycle, std::array{door, board_.vertex_of(rear)})) return false;
  turn(cycle, true);
  return true;
}

/// The lead turns into a cycle through its place, the rear takes that place.
bool Exchanger::exchange_at_block(Local lead, Local rear, std::size_t first) {
  const std::size_t before = board_.shifts().size();
  const Local door = board_.vertex_of(lead);
  for (const Local next : graph_.neighbours(door)) {
    if (graph_.is_bridge(door, next)) continue;
    if (turn_into_cycle(next, door, rear) &&
        free(door, std::array{next, board_.vertex_of(rear)}, nullptr)) {
      board_.move(rear, door);
      const std::size_t last = board_.shifts().size();
      if (exchange_on_cycle(lead, rear)) {
        board_.retrace(first, last, lead, rear);
        return true;
      }
    }
    board_.undo_to(before);
  }
  return false;
}

/// Leads the two by way of `next` to the next junction, and exchanges them there.
bool Exchanger::exchange_down(Local lead, Local rear, Local next, std::size_t first) {
  const std::array pair{board_.vertex_of(lead), board_.vertex_of(rear)};
  std::vector<Local> way(1, next);
  for (Local before = pair[0]; !graph_.on_cycle(way.back()) && graph_.degree(way.back()) <= 2;) {
    const auto near = graph_.neighbours(way.back());
    if (near.size() == 1) return false;
    const Local on = near[0] == before ? near[1] : near[0];
    before = way.back();
    way.push_back(on);
  }
  const Local junction = way.back();
  const Local stem = way.size() > 1 ? way[way.size() - 2] : pair[0];
  std::vector<Local> wanted = way;
  if (!graph_.on_cycle(junction))
    for (const Local side : graph_.neighbours(junction))
      if (side != stem && wanted.size() < way.size() + 2) wanted.push_back(side);
  kept_.clear();
  for (const Local v : wanted) {
    if (!free(v, pair, &kept_)) return false;
    kept_.add(v);
  }
  for (const Local v : way) {
    const Local follow = board_.vertex_of(lead);
    board_.move(lead, v);
    board_.move(rear, follow);
  }
  if (graph_.on_cycle(junction)) return exchange_at_block(lead, rear, first);
  const std::size_t last = board_.shifts().size();
  swap_at_fork(lead, rear, wanted[way.size()], wanted[way.size() + 1]);
  board_.retrace(first, last, lead, rear);
  return true;
}

/// The lead stands on a fork.
bool Exchanger::exchange_at_fork(Local lead, Local rear) {
  const std::size_t first = board_.shifts().size();
  const Local fork = board_.vertex_of(lead), stem = board_.vertex_of(rear);
  const std::array pair{fork, stem};
  std::vector<Local> sides;
  for (const Local side : graph_.neighbours(fork))
    if (side != stem && sides.size() < 2 && free(side, pair, nullptr)) sides.push_back(side);
  if (sides.size() == 2) {
    const std::size_t last = board_.shifts().size();
    swap_at_fork(lead, rear, sides[0], sides[1]);
    board_.retrace(first, last, lead, rear);
    return true;
  }
  board_.undo_to(first);
  // Back by one, so that what is free on the other side can come to all branches.
  for (const Local back : graph_.neighbours(stem)) {
    if (back == fork || !free(back, pair, nullptr)) continue;
    board_.move(rear, back);
    board_.move(lead, stem);
    if (exchange_down(lead, rear, fork, first)) return true;
    break;
  }
  board_.undo_to(first);
  for (const Local next : graph_.neighbours(fork)) {
    if (next == stem) continue;
    if (exchange_down(lead, rear, next, first)) return true;
    board_.undo_to(first);
  }
  return false;
}

bool Exchanger::exchange_behind(Local lead, Local rear) {
  const std::size_t first = board_.shifts().size();
  const Local at = board_.vertex_of(lead), stem = board_.vertex_of(rear);
  bool done = false;
  if (graph_.on_cycle(at)) {
    done = exchange_at_block(lead, rear, first);
  } else if (graph_.degree(at) >= 3) {
    done = exchange_at_fork(lead, rear);
  } else if (graph_.degree(at) == 2) {
    const auto near = graph_.neighbours(at);
    done = exchange_down(lead, rear, near[0] == stem ? near[1] : near[0], first);
  }
  if (!done) board_.undo_to(first);
  return done;
}

bool Exchanger::exchange(Local a, Local b) {
  const Local at = board_.vertex_of(a), next = board_.vertex_of(b);
  if (!graph_.is_bridge(at, next)) return exchange_on_cycle(a, b);
  return exchange_behind(a, b) || exchange_behind(b, a);
}

}  // namespace quadrille::pebbles
