// SPDX-License-Identifier: MIT
#include "quadrille/pebbles/settling.hpp"

#include <algorithm>
#include <climits>
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
/// Timesteps of a crowd in which the agent to be settled next gets no nearer, and how often it is
/// helped by one step before it is led all the way. Tried with 1, 2, 3, 5 and 0, 5, 10, 30 on a
/// maze and rooms of 32 x 32, two seeds each: makespans of 2,284 to 4,977 and 2,335 to 4,287, seeds
/// differ by as much as settings, and these two are among the better ones, no more.
constexpr int kPatience = 2, kMostHelps = 5;
constexpr int kAll = INT_MAX;

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
                   Rotations rotations, MakeCrowd make_crowd)
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
      make_crowd_(std::move(make_crowd)),
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
    if (make_crowd_) begin_crowd(limits);
    if (crowd_ != nullptr && is_crowd_of_use()) {
      crowd_->advance(board_, graph_.size() - next_);
      ++num_idle_;
    } else if (!settle(order_[next_ - 1], crowd_ != nullptr && num_helps_ < kMostHelps ? 1 : kAll,
                       limits)) {
      return State::given_up;
    }
    pass_settled();
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

/// Where there are hardly any cycles nobody can go round somebody else, and what all do at once is
/// in each other's way. Measured on a maze of corridors of one cell with 1,000 agents: 178,709
/// timesteps instead of 152,328.
void Settling::begin_crowd(LimitMonitor& limits) {
  Local num_on_cycles = 0;
  for (Local v = 0; v < graph_.size(); ++v) num_on_cycles += graph_.on_cycle(v) ? 1 : 0;
  if (2 * num_on_cycles >= graph_.size()) {
    std::vector<Local> places, order;
    for (Local agent = 0; agent < starts_.size(); ++agent) places.push_back(goal_.vertex_of(agent));
    for (Local k = graph_.size(); k-- > num_free_;) order.push_back(goal_.agent_at(order_[k]));
    crowd_ = make_crowd_(places, order, limits);
  }
  if (crowd_ != nullptr || !limits.exhausted()) make_crowd_ = nullptr;
  watch();
}

/// The agent that is to be settled next gets nearer to its vertex; if not, it is led on by one
/// step, and after some of these all the way.
bool Settling::is_crowd_of_use() {
  const Local agent = goal_.agent_at(order_[next_ - 1]);
  const Local distance = crowd_->distance(agent, board_.vertex_of(agent));
  if (distance < least_distance_) {
    least_distance_ = distance;
    num_idle_ = 0;
  }
  if (num_idle_ < kPatience) return true;
  num_idle_ = 0;
  ++num_helps_;
  least_distance_ = kNoLocal;
  return false;
}

void Settling::watch() {
  num_idle_ = num_helps_ = 0;
  least_distance_ = kNoLocal;
}

void Settling::pass_settled() {
  const Local before = next_;
  while (next_ > num_free_ &&
         board_.agent_at(order_[next_ - 1]) == goal_.agent_at(order_[next_ - 1]))
    --next_;
  if (next_ < before) watch();
}

/// Leads the right agent to a vertex, by so many steps at most. False: somebody is in its way who
/// cannot be exchanged. May stop on the way when a limit is met.
bool Settling::settle(Local v, int most_steps, LimitMonitor& limits) {
  const Local agent = goal_.agent_at(v);
  if (board_.vertex_of(agent) == v) return true;
  for (const Local to : way_to(board_.vertex_of(agent), v)) {
    if (most_steps-- == 0 || limits.exhausted()) return true;
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
  if (crowd_ != nullptr) effort_ += crowd_->effort();
  crowd_.reset();
  board_.replace_shifts(without_loops(board_.shifts(), starts_, graph_.size(), kRounds));
  return State::found;
}

void Settling::shorten_if_long() {
  if (board_.shifts().size() < long_) return;
  board_.replace_shifts(without_loops(board_.shifts(), starts_, graph_.size(), 1));
  long_ = std::max(kManyShifts, 2 * board_.shifts().size());
}

}  // namespace quadrille::pebbles
