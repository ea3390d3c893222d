// SPDX-License-Identifier: MIT
#include "full_block.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace quadrille::pebbles {
namespace {

/// States of a search, at most: tables have four bytes for each.
constexpr std::size_t kMostStates = 32'000'000;

}  // namespace

void turn_once(const Cycle& cycle, bool forwards, Board& board) {
  if (forwards) {
    board.rotate(cycle);
    return;
  }
  const Cycle back(cycle.rbegin(), cycle.rend());
  board.rotate(back);
}

FullBlock::FullBlock(const LocalGraph& graph, std::vector<Local> vertices)
    : graph_(graph),
      vertices_(std::move(vertices)),
      index_(graph.size(), kNoLocal),
      cycles_at_(vertices_.size()) {
  for (Local k = 0; k < vertices_.size(); ++k) index_[vertices_[k]] = k;
}

std::uint32_t FullBlock::add_cycle(Cycle cycle) {
  const auto number = static_cast<std::uint32_t>(cycles_.size());
  for (const Local v : cycle) cycles_at_[index_[v]].push_back(number);
  cycles_.push_back(std::move(cycle));
  return number;
}

/// A shortest one that leads from b to a along their edge, without another vertex: a is first, b
/// last.
std::optional<Cycle> FullBlock::cycle_through(Local a, Local b, Local without) const {
  std::map<Local, Local> parent{{b, kNoLocal}};
  std::vector<Local> queue{b};
  for (std::size_t head = 0; head < queue.size() && !parent.contains(a); ++head)
    for_each_neighbour(queue[head], [&](Local w) {
      if (w == without || (queue[head] == b && w == a)) return;
      if (parent.emplace(w, queue[head]).second) queue.push_back(w);
    });
  if (!parent.contains(a)) return std::nullopt;
  Cycle cycle;
  for (Local v = a; v != kNoLocal; v = parent.at(v)) cycle.push_back(v);
  return cycle;
}

// ---- what can be exchanged at once --------------------------------------------------------------

/// A path outside of a cycle without chords between two of its vertices, both included.
std::optional<Cycle> FullBlock::find_ear(const Cycle& cycle) const {
  struct Label {
    Local root, parent;
  };
  std::map<Local, Label> labels;
  std::vector<Local> queue = cycle;
  for (const Local v : cycle) labels[v] = {v, kNoLocal};
  const auto up = [&](Local v) {
    Cycle way;
    for (; v != kNoLocal; v = labels.at(v).parent) way.push_back(v);
    return way;
  };
  std::optional<Cycle> ear;
  for (std::size_t head = 0; head < queue.size() && !ear; ++head) {
    const Local at = queue[head];
    const Label label = labels.at(at);
    for_each_neighbour(at, [&](Local w) {
      if (ear || w == label.parent) return;
      const auto [found, is_new] = labels.emplace(w, Label{label.root, at});
      if (is_new) queue.push_back(w);
      const bool both_on_cycle = label.parent == kNoLocal && found->second.parent == kNoLocal;
      if (is_new || both_on_cycle || found->second.root == label.root) return;
      ear = up(at);
      std::reverse(ear->begin(), ear->end());
      const Cycle rest = up(w);
      ear->insert(ear->end(), rest.begin(), rest.end());
    });
  }
  return ear;
}

/// docs/feasibility.md, section 3, "Theta": r, then h, then g backwards exchanges u and the last of
/// b. Here the ear is c, and the cycle is a and b.
FullBlock::Exchange FullBlock::transposition_of(const Cycle& cycle, const Cycle& ear) {
  Cycle ring = cycle;
  const Local u = ear.front(), v = ear.back();
  std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), u), ring.end());
  if (ring.back() == v) std::reverse(ring.begin() + 1, ring.end());  // b needs a vertex.
  const auto at_v = std::find(ring.begin(), ring.end(), v);
  const Cycle a(ring.begin() + 1, at_v), b(at_v + 1, ring.end());
  const Cycle c(ear.begin() + 1, ear.end() - 1), c_back(c.rbegin(), c.rend());
  const auto joined = [](Local first, const Cycle& x, Local middle, const Cycle& y) {
    Cycle all{first};
    all.insert(all.end(), x.begin(), x.end());
    all.push_back(middle);
    all.insert(all.end(), y.begin(), y.end());
    return all;
  };
  const std::uint32_t g = add_cycle(joined(u, a, v, b));
  const std::uint32_t h = add_cycle(joined(u, a, v, c_back));
  const std::uint32_t r = add_cycle(joined(v, b, u, c));
  return {{{b.back(), u, kNoLocal}, 2}, {{r, true}, {h, true}, {g, false}}};
}

/// The commutator of two cycles that share one vertex.
std::optional<FullBlock::Exchange> FullBlock::find_three_cycle() const {
  for (const auto& here : cycles_at_) {
    if (here.size() < 2) continue;
    const Turn g{here[0], true}, h{here[1], true};
    Exchange found{{}, {g, h, g.back(), h.back()}};
    const auto image = [&](Local place) {
      for (const Turn turn : found.turns) place = after(turn, place);
      return place;
    };
    const auto moved =
        std::find_if(vertices_.begin(), vertices_.end(), [&](Local v) { return image(v) != v; });
    if (moved == vertices_.end()) continue;
    found.places = {{*moved, image(*moved), image(image(*moved))}, 3};
    return found;
  }
  return std::nullopt;
}

/// Two agents that can be exchanged, or else three; and cycles whose rotations lead everywhere.
bool FullBlock::find_base() {
  std::map<Cycle, bool> known;
  for (const Local a : vertices_)
    for_each_neighbour(a, [&](Local b) {
      if (a > b) return;
      Cycle cycle = *cycle_through(a, b, kNoLocal), sorted = cycle;
      std::sort(sorted.begin(), sorted.end());
      if (known.emplace(std::move(sorted), true).second) add_cycle(std::move(cycle));
    });
  for (std::size_t k = 0; k < cycles_.size(); ++k)
    if (const auto ear = find_ear(cycles_[k])) {
      const Cycle cycle = cycles_[k];
      base_ = transposition_of(cycle, *ear);
      return true;
    }
  auto three = find_three_cycle();
  if (three) base_ = std::move(*three);
  return three.has_value();
}

bool FullBlock::is_odd(const Board& goal, const Board& board) const {
  bool odd = false;
  std::vector<bool> seen(vertices_.size(), false);
  for (const Local first : vertices_)
    for (Local v = first; !seen[index_[v]];) {
      seen[index_[v]] = true;
      v = goal.vertex_of(board.agent_at(v));
      odd ^= v != first;
    }
  return odd;
}

// ---- anywhere -----------------------------------------------------------------------------------

Local FullBlock::after(Turn turn, Local place) const {
  const Cycle& cycle = cycles_[turn.cycle];
  const auto at = std::find(cycle.begin(), cycle.end(), place);
  if (at == cycle.end()) return place;
  if (turn.forwards) return at + 1 == cycle.end() ? cycle.front() : *(at + 1);
  return at == cycle.begin() ? cycle.back() : *(at - 1);
}

std::size_t FullBlock::state_of(const Places& places) const {
  std::size_t state = 0;
  for (const Local v : places.used()) state = state * vertices_.size() + index_[v];
  return state;
}

/// Breadth first from the places of the base, by turns, to all places.
bool FullBlock::explore(LimitMonitor& limits, std::int64_t& effort) {
  std::size_t num_states = 1;
  for (std::size_t k = 0; k < base_.places.count; ++k) {
    if (num_states > kMostStates / vertices_.size()) return false;
    num_states *= vertices_.size();
  }
  if (!limits.has_room_for(2 * num_states * sizeof(Places))) return false;
  reached_by_.assign(num_states, kUnreached);
  std::vector<Places> queue{base_.places};
  reached_by_[state_of(base_.places)] = kBase;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    if (limits.exhausted()) return false;
    const Places places = queue[head];
    for (const Local v : places.used())
      for (const std::uint32_t cycle : cycles_at_[index_[v]])
        for (const bool forwards : {false, true}) {
          ++effort;
          Places to = places;
          for (Local& place : to.used()) place = after({cycle, forwards}, place);
          std::uint32_t& mark = reached_by_[state_of(to)];
          if (mark != kUnreached) continue;
          mark = 2 * cycle + (forwards ? 1 : 0) + 1;
          queue.push_back(to);
        }
  }
  return true;
}

/// Who is at one of the places goes to the next one. Requires that they were reached.
void FullBlock::exchange(Places places, Board& board, std::int64_t& effort) const {
  const auto apply = [&](Turn turn) { turn_once(cycles_[turn.cycle], turn.forwards, board); };
  std::vector<Turn> way;
  for (;;) {
    const std::uint32_t mark = reached_by_[state_of(places)];
    if (mark == kBase) break;
    const Turn turn{(mark - 1) / 2, (mark - 1) % 2 == 1};
    way.push_back(turn);
    apply(turn.back());
    for (Local& v : places.used()) v = after(turn.back(), v);
    ++effort;
  }
  for (const Turn turn : base_.turns) apply(turn);
  for (; !way.empty(); way.pop_back()) apply(way.back());
}

// ---- nearby -------------------------------------------------------------------------------------

/// The vertices after `from` on a shortest way to a neighbour of `to`, with that one at the end.
std::vector<Local> FullBlock::way_beside(Local from, Local to) const {
  std::map<Local, Local> next{{to, kNoLocal}};
  std::vector<Local> queue{to};
  for (std::size_t head = 0; !next.contains(from); ++head)
    for_each_neighbour(queue[head], [&](Local w) {
      if (next.emplace(w, queue[head]).second) queue.push_back(w);
    });
  std::vector<Local> way;
  for (Local v = next.at(from); v != to && v != kNoLocal; v = next.at(v)) way.push_back(v);
  return way;
}

/// The least theta around a cycle through the edge, explored.
std::optional<FullBlock> FullBlock::theta_of(Local a, Local b, LimitMonitor& limits,
                                             std::int64_t& effort) const {
  Cycle vertices = *cycle_through(a, b, kNoLocal);
  const auto ear = find_ear(vertices);
  if (!ear) return std::nullopt;
  vertices.insert(vertices.end(), ear->begin() + 1, ear->end() - 1);
  std::optional<FullBlock> theta(std::in_place, graph_, std::move(vertices));
  const bool can = theta->find_base() && theta->explore(limits, effort) &&
                   theta->has_reached({{a, b, kNoLocal}, 2});
  if (!can) theta.reset();
  return theta;
}

/// Rotations bring who is at `from` beside `to`; the two are exchanged there, and the rotations
/// taken back. False, and nothing is changed, where short cycles do not allow that.
bool FullBlock::exchange_nearby(Local from, Local to, Board& board, LimitMonitor& limits,
                                std::int64_t& effort) {
  std::vector<Cycle> turned;
  Local at = from;
  bool can = true;
  for (const Local next : way_beside(from, to)) {
    auto cycle = cycle_through(next, at, to);
    effort += 8;
    if (!(can = cycle.has_value())) break;
    board.rotate(*cycle);
    turned.push_back(std::move(*cycle));
    at = next;
  }
  const auto theta = can ? theta_of(at, to, limits, effort) : std::nullopt;
  if (theta) theta->exchange({{at, to, kNoLocal}, 2}, board, effort);
  for (; !turned.empty(); turned.pop_back()) turn_once(turned.back(), false, board);
  return theta.has_value();
}

bool FullBlock::settle(Local v, std::size_t next, const Board& goal, Board& board,
                       LimitMonitor& limits, std::int64_t& effort) {
  const Local from = board.vertex_of(goal.agent_at(v));
  if (!has_base_ && exchange_nearby(from, v, board, limits, effort)) return true;
  if (limits.exhausted()) return false;
  if (!has_base_) {
    has_base_ = find_base();
    if (!has_base_) return false;
    if (base_.places.count == 3 && is_odd(goal, board)) {
      const auto even = std::find_if(cycles_.begin(), cycles_.end(),
                                     [](const Cycle& cycle) { return cycle.size() % 2 == 0; });
      if (even == cycles_.end()) return false;
      board.rotate(*even);
      // Vertices that were settled are not any more.
      return explore(limits, effort) && sort(goal, board, limits, effort);
    }
    if (!explore(limits, effort)) return false;
  }
  Places places{{from, v, kNoLocal}, base_.places.count};
  if (places.count == 3) {
    const auto other = std::find_if(vertices_.begin() + static_cast<std::ptrdiff_t>(next),
                                    vertices_.end(), [&](Local w) { return w != from && w != v; });
    if (other == vertices_.end()) return false;
    places.at[2] = *other;
  }
  if (!has_reached(places)) return false;
  exchange(places, board, effort);
  return true;
}

bool FullBlock::sort(const Board& goal, Board& board, LimitMonitor& limits, std::int64_t& effort) {
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    const Local v = vertices_[k];
    if (board.agent_at(v) == goal.agent_at(v)) continue;
    if (limits.exhausted() || !settle(v, k, goal, board, limits, effort)) return false;
  }
  return true;
}

}  // namespace quadrille::pebbles
