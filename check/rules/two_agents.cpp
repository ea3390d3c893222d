// SPDX-License-Identifier: MIT
#include <algorithm>

#include "rules/rules.hpp"

namespace quadrille_check {
namespace {

const Variable* usage(const Meanings& meanings, Int lit) {
  const Variable& x = meanings.variable(lit);
  return lit > 0 && x.kind == Variable::Kind::does_not ? &x : nullptr;
}

/// The agent and the one place and time that a false literal says it is at; a null place if it says
/// something else.
struct Presence {
  int agent = 0, place = -1, time = 0;
};
Presence presence(const Meanings& meanings, Int lit) {
  const Variable& x = meanings.variable(lit);
  const bool is_said = lit > 0 ? x.kind == Variable::Kind::does_not && !x.is_edge
                               : x.kind == Variable::Kind::is_there;
  if (!is_said || x.visits.size() != 1 || x.visits[0].first != x.visits[0].last) return {};
  return {x.agent, x.visits[0].place, x.visits[0].first};
}

}  // namespace

bool is_same_place(const Meanings& meanings, Clause clause) {
  if (clause.size() != 2) return false;
  const Presence a = presence(meanings, clause[0]), b = presence(meanings, clause[1]);
  if (a.place >= 0 && b.place >= 0)
    return a.agent != b.agent && a.place == b.place && a.time == b.time;
  const Variable* const x = usage(meanings, clause[0]);
  const Variable* const y = usage(meanings, clause[1]);
  return x != nullptr && y != nullptr && x->is_edge && y->is_edge && x->agent != y->agent &&
         x->time == y->time && std::minmax(x->from, x->to) == std::minmax(y->from, y->to);
}

bool is_swap(const Meanings& meanings, Clause clause) {
  if (clause.size() != 4) return false;
  Presence at[4];
  for (std::size_t k = 0; k < 4; ++k) at[k] = presence(meanings, clause[k]);
  std::sort(at, at + 4, [](const Presence& a, const Presence& b) {
    return std::pair(a.agent, a.time) < std::pair(b.agent, b.time);
  });
  const auto& [from, to, other_from, other_to] = at;
  return from.place >= 0 && other_from.place >= 0 && from.agent == to.agent &&
         other_from.agent == other_to.agent && from.agent != other_from.agent &&
         to.time == from.time + 1 && other_from.time == from.time && other_to.time == to.time &&
         from.place != to.place && to.place == other_from.place && other_to.place == from.place;
}

bool is_rectangle(const Instance& instance, const Meanings& meanings, Clause clause,
                  std::span<const Int> parameters) {
  if (parameters.size() != 7 || !instance.is_grid()) return false;
  const Int x0 = parameters[0], y0 = parameters[1], x1 = parameters[2], y1 = parameters[3];
  const Int begin = parameters[4], num_agents = static_cast<Int>(instance.agents().size());
  const auto is_cell = [&](Int x, Int y) {
    return x >= 0 && y >= 0 && x < instance.width() && y < instance.height();
  };
  if (!is_cell(x0, y0) || !is_cell(x1, y1) || begin < -kEndOfTime || begin > kEndOfTime)
    return false;
  const Int a = parameters[5], b = parameters[6];
  if (a < 0 || b < 0 || a >= num_agents || b >= num_agents || a == b) return false;
  const Int dx = x1 < x0 ? -1 : 1, dy = y1 < y0 ? -1 : 1;
  const Int width = dx * (x1 - x0), height = dy * (y1 - y0);
  if (width + height == 0) return false;

  // Entry and exit of a at x0 and x1, of b at y0 and y1.
  const auto is_on = [&](int side, int place, int time) {
    const Int x = place % instance.width(), y = place / instance.width();
    const Int right = dx * (x - x0), down = dy * (y - y0);
    if (right < 0 || right > width || down < 0 || down > height) return false;
    if (time != begin + right + down) return false;
    return side == 0 ? x == x0 : side == 1 ? x == x1 : side == 2 ? y == y0 : y == y1;
  };
  for (int side = 0; side < 4; ++side) {
    const Int agent = side < 2 ? a : b;
    bool is_made = is_on(side, instance.agents()[static_cast<std::size_t>(agent)].start, 0);
    for (const Int lit : clause) {
      const Variable* const x = usage(meanings, lit);
      if (x == nullptr || x->agent != agent || x->is_edge || x->visits.empty()) continue;
      is_made = is_made || std::all_of(x->visits.begin(), x->visits.end(), [&](const Visit& visit) {
                  return visit.first == visit.last && is_on(side, visit.place, visit.first);
                });
    }
    if (!is_made) return false;
  }
  return true;
}

namespace {

/// A chain of places with two neighbours, and where it ends.
struct Chain {
  std::vector<int> inner;
  int ends[2] = {-1, -1};
};

/// False: it runs in a circle.
bool find_chain(const Instance& instance, int inside, Chain& chain) {
  chain.inner.push_back(inside);
  for (int side = 0; side < 2; ++side) {
    int before = inside, at = instance.neighbours(inside)[static_cast<std::size_t>(side)];
    while (instance.neighbours(at).size() == 2) {
      if (at == inside) return false;
      chain.inner.push_back(at);
      const auto both = instance.neighbours(at);
      const int next = both[0] == before ? both[1] : both[0];
      before = at;
      at = next;
    }
    chain.ends[side] = at;
  }
  return chain.ends[0] != chain.ends[1];
}

}  // namespace

bool is_corridor(const Instance& instance, const Meanings& meanings, Distances& distances,
                 Clause clause, std::span<const Int> parameters) {
  if (parameters.size() != 1 || clause.size() != 2 || !instance.has(parameters[0])) return false;
  const int inside = static_cast<int>(parameters[0]);
  const Variable* const a = usage(meanings, clause[0]);
  const Variable* const b = usage(meanings, clause[1]);
  if (a == nullptr || b == nullptr || a->agent == b->agent || a->visits.size() != 1 ||
      b->visits.size() != 1 || instance.neighbours(inside).size() != 2)
    return false;
  Chain chain;
  if (!find_chain(instance, inside, chain)) return false;
  const Visit &exit_a = a->visits[0], &exit_b = b->visits[0];
  const bool are_opposite = (exit_a.place == chain.ends[0] && exit_b.place == chain.ends[1]) ||
                            (exit_a.place == chain.ends[1] && exit_b.place == chain.ends[0]);
  if (!are_opposite) return false;
  const int start_a = instance.agents()[static_cast<std::size_t>(a->agent)].start;
  const int start_b = instance.agents()[static_cast<std::size_t>(b->agent)].start;
  for (const int place : chain.inner)
    if (place == start_a || place == start_b) return false;
  const auto distance = [&](int from, int to, int without) {
    return Int{(*distances.from(from, without))[static_cast<std::size_t>(to)]};
  };
  const Int length = static_cast<Int>(chain.inner.size()) + 1;
  const Int first_a = distance(start_a, exit_a.place, -1);
  const Int first_b = distance(start_b, exit_b.place, -1);
  const Int around_a = distance(start_a, exit_a.place, inside);
  const Int around_b = distance(start_b, exit_b.place, inside);
  return exit_a.last <= std::min(around_a - 1, first_b + length) &&
         exit_b.last <= std::min(around_b - 1, first_a + length);
}

}  // namespace quadrille_check
