// SPDX-License-Identifier: MIT
#include "quadrille/pebbles/settling.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "full_blocks.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/pebbles/shorten.hpp"

namespace quadrille::pebbles {
namespace {

/// Roots that are tried: from a good one all vertices are near.
constexpr Local kRoots = 16;
/// Shifts from which on loops are left out on the way.
constexpr std::size_t kManyShifts = 1'000'000;
constexpr int kRounds = 5;

/// The vertices of a component, nearest to a root first.
std::vector<Local> order_from(const LocalGraph& graph, Local root, Local& depth) {
  std::vector<Local> distance(graph.size(), kNoLocal);
  std::vector<Local> order{root};
  distance[root] = 0;
  for (std::size_t head = 0; head < order.size(); ++head)
    for (const Local w : graph.neighbours(order[head]))
      if (distance[w] == kNoLocal) {
        distance[w] = distance[order[head]] + 1;
        order.push_back(w);
      }
  depth = distance[order.back()];
  return order;
}

std::vector<Local> best_order(const LocalGraph& graph) {
  std::vector<Local> best;
  Local least = kNoLocal;
  const Local step = std::max<Local>(1, graph.size() / kRoots);
  for (Local root = 0; root < graph.size(); root += step) {
    Local depth = 0;
    std::vector<Local> order = order_from(graph, root, depth);
    if (depth >= least) continue;
    least = depth;
    best = std::move(order);
  }
  return best;
}

}  // namespace

Settling::Settling(LocalGraph graph, std::vector<Local> starts, std::vector<Local> goals,
                   Rotations rotations)
    : graph_(std::move(graph)),
      starts_(starts),
      rotations_(rotations),
      board_(graph_.size(), std::move(starts)),
      goal_(graph_.size(), std::move(goals)),
      exchanger_(graph_, board_, rotations),
      num_free_(graph_.size() - static_cast<Local>(starts_.size())),
      order_(best_order(graph_)),
      rank_(graph_.size()),
      next_(graph_.size()),
      long_(kManyShifts) {
  for (Local k = 0; k < order_.size(); ++k) rank_[order_[k]] = k;
}

Settling::State Settling::step(LimitMonitor& limits) {
  if (num_free_ == 0 && rotations_ == Rotations::forbidden)
    return starts_ == goal_.vertices() ? State::found : State::given_up;
  if (num_free_ == 0) {
    if (!rearrange_full_component(graph_, goal_, board_, limits, effort_))
      return limits.exhausted() ? State::working : State::given_up;
    return finish();
  }
  if (next_ == graph_.size() && !has_begun_) gather_goals();
  if (next_ > num_free_) {
    if (!settle(order_[next_ - 1], limits)) return State::given_up;
    if (board_.agent_at(order_[next_ - 1]) == goal_.agent_at(order_[next_ - 1])) --next_;
    shorten_if_long();
    return State::working;
  }
  board_.retrace(goal_);
  return finish();
}

/// The free vertices of the goals' arrangement become the first ones of the order.
void Settling::gather_goals() {
  has_begun_ = true;
  Exchanger gatherer(graph_, goal_);
  Exchanger::Marks kept(graph_.size());
  kept.clear();
  for (Local k = 0; k < num_free_; ++k) {
    const bool done = gatherer.free(order_[k], {}, &kept);
    QUADRILLE_REQUIRE(done, "there are as many free vertices");
    kept.add(order_[k]);
  }
  effort_ += gatherer.effort();
}

/// A shortest way of an agent to a vertex among those that are not settled.
std::vector<Local> Settling::way_to(Local from, Local to) {
  std::vector<Local> queue{to};
  std::vector<Local> next(graph_.size(), kNoLocal);
  next[to] = to;
  for (std::size_t head = 0; next[from] == kNoLocal; ++head) {
    QUADRILLE_REQUIRE(head < queue.size(), "what is nearer to the root is connected");
    ++effort_;
    for (const Local w : graph_.neighbours(queue[head]))
      if (next[w] == kNoLocal && rank_[w] < next_) {
        next[w] = queue[head];
        queue.push_back(w);
      }
  }
  std::vector<Local> way;
  for (Local v = from; v != to; v = next[v]) way.push_back(next[v]);
  return way;
}

/// Leads the right agent to a vertex. False: somebody is in its way who cannot be exchanged. May
/// stop on the way when a limit is met.
bool Settling::settle(Local v, LimitMonitor& limits) {
  const Local agent = goal_.agent_at(v);
  if (board_.vertex_of(agent) == v) return true;
  for (const Local to : way_to(board_.vertex_of(agent), v)) {
    if (limits.exhausted()) return true;
    const Local from = board_.vertex_of(agent);
    if (exchanger_.free(to, std::span(&from, 1), nullptr, rank_, next_))
      board_.move(agent, to);
    else if (!exchanger_.exchange(agent, board_.agent_at(to)))
      return false;
    QUADRILLE_REQUIRE(board_.vertex_of(agent) == to, "each step leads nearer to the goal");
  }
  return true;
}

Settling::State Settling::finish() {
  board_.replace_shifts(without_loops(board_.shifts(), starts_, graph_.size(), kRounds));
  return State::found;
}

void Settling::shorten_if_long() {
  if (board_.shifts().size() < long_) return;
  board_.replace_shifts(without_loops(board_.shifts(), starts_, graph_.size(), 1));
  long_ = std::max(kManyShifts, 2 * board_.shifts().size());
}

}  // namespace quadrille::pebbles
