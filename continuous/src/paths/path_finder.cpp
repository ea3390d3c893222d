// SPDX-License-Identifier: MIT
#include "paths/path_finder.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

constexpr std::uint32_t kNoParent = 0xffffffffu;

/// The first start at `tick` or later that no ban forbids.
Ticks allowed_start(const std::vector<TickInterval>& forbidden, Ticks tick) {
  auto at = std::partition_point(forbidden.begin(), forbidden.end(),
                                 [&](const TickInterval& starts) { return starts.end <= tick; });
  for (; at != forbidden.end() && at->begin <= tick; ++at) tick = at->end;
  return tick;
}

const std::vector<TickInterval> kNothingForbidden;
const std::vector<BanTable::SafeStay> kAlwaysSafe{{0, kForever}};

}  // namespace

// Of equal keys the one that is nearer to its end comes first.
bool PathFinder::is_later(const Entry& a, const Entry& b) {
  if (a.key != b.key) return a.key > b.key;
  if (a.arrive != b.arrive) return a.arrive < b.arrive;
  return a.node < b.node;
}

void PathFinder::begin(Order order) {
  order_ = order;
  ++num_runs_;
  ++run_;
  nodes_.clear();
  heap_.clear();
  num_states_ = instance_.roadmap().num_vertices();
  if (best_.size() < num_states_) {
    best_.resize(num_states_);
    stamp_.resize(num_states_, 0);
  }
  for (const std::size_t v : passed_) arrivals_[v].clear();
  passed_.clear();
  if (!instance_.roadmap().no_waiting().empty()) arrivals_.resize(num_states_);
}

std::size_t PathFinder::state(BanTable& bans, VertexId v, std::uint32_t stay) {
  const std::uint32_t place = bans.stays_of(v);
  if (place == BanTable::kFree) return v.index();
  if (first_state_.size() <= place) {
    first_state_.resize(place + 1);
    first_stamp_.resize(place + 1, 0);
  }
  if (first_stamp_[place] != run_) {
    first_stamp_[place] = run_;
    first_state_[place] = num_states_;
    num_states_ += bans.safe_stays(place).size();
    if (best_.size() < num_states_) {
      best_.resize(2 * num_states_);
      stamp_.resize(2 * num_states_, 0);
    }
  }
  return first_state_[place] + stay;
}

void PathFinder::visit(const Node& node, Ticks rest) {
  if (++num_visits_ % 64 == 0 && limits_ != nullptr) limits_->check();
  nodes_.push_back(node);
  push(order_ == Order::cheapest_first ? node.arrive + rest : rest,
       static_cast<std::uint32_t>(nodes_.size() - 1));
}

void PathFinder::push(Ticks key, std::uint32_t node) {
  heap_.push_back({key, nodes_[node].arrive, node});
  std::push_heap(heap_.begin(), heap_.end(), is_later);
}

std::optional<Ticks> PathFinder::find(const PathTask& task, BanTable& bans, Ticks bound,
                                      TimedPath* path) {
  return search(Order::cheapest_first, task, bans, bound, path);
}

bool PathFinder::find_any(const PathTask& task, BanTable& bans, Ticks bound, TimedPath* path) {
  return search(Order::nearest_first, task, bans, bound, path).has_value();
}

std::optional<Ticks> PathFinder::search(Order order, const PathTask& task, BanTable& bans,
                                        Ticks bound, TimedPath* path) {
  begin(order);
  if (!instance_.roadmap().no_waiting().empty()) horizon_ = bans.horizon();
  const Agent& agent = instance_.agent(task.agent);
  bound = std::min(bound, arrival_bound(instance_, task.agent));
  const bool is_goal = agent.goals.contains(agent.start);
  // Who leaves where it starts is gone at once.
  const Ticks release = is_goal && agent.leaves ? Ticks{0} : agent.release;
  const Ticks least = is_goal ? Ticks{0} : release + task.distances[agent.start];
  if (least >= bound) return std::nullopt;
  const std::uint32_t start_place = bans.stays_of(agent.start);
  const auto& stays = start_place == BanTable::kFree ? kAlwaysSafe : bans.safe_stays(start_place);
  if (stays.empty() || stays.front().from > 0 || stays.front().until < release) return std::nullopt;
  if (is_goal && release > 0 && stays.front().until == kForever) {
    if (path != nullptr) *path = {{}, 0};
    return Ticks{0};
  }
  // Whoever is not released need not be looked at before it is.
  const std::size_t first = state(bans, agent.start, 0);
  best_[first] = release;
  stamp_[first] = run_;
  visit({agent.start, 0, release, stays.front().until, kNoParent, {}}, task.distances[agent.start]);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), is_later);
    const auto [key, arrive, index] = heap_.back();
    heap_.pop_back();
    const Node node = nodes_[index];
    if (is_stale(node, bans)) continue;
    // No goal where nobody may wait is one of an agent that stays.
    if ((node.leave_by == kForever || agent.leaves) && agent.goals.contains(node.vertex)) {
      if (path != nullptr) trace(index, *path);
      return node.arrive;
    }
    expand(task, bans, index, order == Order::cheapest_first ? key : bound - 1, bound);
  }
  return std::nullopt;
}

void PathFinder::expand(const PathTask& task, BanTable& bans, std::uint32_t index, Ticks estimate,
                        Ticks bound) {
  const Node node = nodes_[index];
  const Ticks least = node.arrive + task.distances[node.vertex];
  const auto detours = task.detours.from(node.vertex);
  std::uint32_t at = node.num_expanded;
  for (; at < detours.size() && least + detours[at].extra <= estimate; ++at) {
    const auto& [e, w, duration, extra] = detours[at];
    if (least + extra >= bound) return;
    ++num_edges_;
    if (!instance_.roadmap().may_wait(w)) {
      pass(task, bans, index, e, bound);
      continue;
    }
    const Ticks rest = task.distances[w];
    const std::uint32_t start_place = bans.starts_of(e, node.arrive), stay_place = bans.stays_of(w);
    const auto& forbidden =
        start_place == BanTable::kFree ? kNothingForbidden : bans.forbidden_starts(start_place);
    const auto& stays = stay_place == BanTable::kFree ? kAlwaysSafe : bans.safe_stays(stay_place);
    const Ticks earliest = node.arrive + duration;
    auto stay = std::partition_point(
        stays.begin(), stays.end(),
        [earliest](const BanTable::SafeStay& s) { return s.until < earliest; });
    for (; stay != stays.end(); ++stay) {
      const Ticks start = allowed_start(forbidden, std::max(node.arrive, stay->from - duration));
      const Ticks arrive = start + duration;
      if (start > node.leave_by || arrive + rest >= bound) break;
      if (arrive > stay->until) continue;
      const auto k = static_cast<std::uint32_t>(stay - stays.begin());
      const std::size_t s = state(bans, w, k);
      if (stamp_[s] == run_ && best_[s] <= arrive) continue;
      stamp_[s] = run_;
      best_[s] = arrive;
      visit({w, k, arrive, stay->until, index, {e, start}}, rest);
    }
  }
  if (at == detours.size() || least + detours[at].extra >= bound) return;
  nodes_[index].num_expanded = at;
  push(least + detours[at].extra, index);
}

// Each run of starts that are allowed, at which the agent can be there and come to a safe arrival.
void PathFinder::pass(const PathTask& task, BanTable& bans, std::uint32_t index, EdgeId e,
                      Ticks bound) {
  const Node node = nodes_[index];
  const VertexId w = instance_.roadmap().to(e);
  const Ticks duration = instance_.duration(instance_.class_of(task.agent), e);
  const Ticks rest = task.distances[w];
  const std::uint32_t start_place = bans.starts_of(e, node.arrive), stay_place = bans.stays_of(w);
  const auto& forbidden =
      start_place == BanTable::kFree ? kNothingForbidden : bans.forbidden_starts(start_place);
  const auto& stays = stay_place == BanTable::kFree ? kAlwaysSafe : bans.safe_stays(stay_place);
  for (const BanTable::SafeStay& stay : stays) {
    const Ticks last = std::min(node.leave_by, stay.until - duration);
    Ticks start = std::max(node.arrive, stay.from - duration);
    while (start <= last) {
      if (++num_edges_ % 64 == 0 && limits_ != nullptr) limits_->check();
      start = allowed_start(forbidden, start);
      if (start > last || start + duration + rest >= bound) break;
      const auto next =
          std::partition_point(forbidden.begin(), forbidden.end(),
                               [&](const TickInterval& starts) { return starts.begin <= start; });
      const Ticks until = next == forbidden.end() ? last : std::min(last, next->begin - 1);
      const Ticks first = start + duration;
      const Arrivals arrivals{first, std::max(first, std::min(until + duration, horizon_))};
      if (!is_known(w, arrivals))
        visit({w, kPasses, arrivals.first, arrivals.last, index, {e, start}}, rest);
      start = until + 1;
    }
  }
}

// From the horizon on nothing changes, so that whatever can be done after an arrival can be done
// after an earlier one, earlier.
bool PathFinder::is_known(VertexId v, const Arrivals& arrivals) {
  std::vector<Arrivals>& known = arrivals_[v.index()];
  const auto is_as_good = [&](const Arrivals& other) {
    return other.contain(arrivals) || (horizon_ <= other.last && other.last <= arrivals.first);
  };
  if (std::any_of(known.begin(), known.end(), is_as_good)) return true;
  if (known.empty()) passed_.push_back(v.index());
  std::erase_if(known, [&](const Arrivals& other) { return arrivals.contain(other); });
  known.push_back(arrivals);
  return false;
}

bool PathFinder::is_stale(const Node& node, BanTable& bans) {
  if (node.stay != kPasses) return best_[state(bans, node.vertex, node.stay)] < node.arrive;
  const std::vector<Arrivals>& known = arrivals_[node.vertex.index()];
  return std::none_of(known.begin(), known.end(), [&](const Arrivals& arrivals) {
    return arrivals.first == node.arrive && arrivals.last == node.leave_by;
  });
}

// Who passed left at the tick of the next move, and came then.
void PathFinder::trace(std::uint32_t node, TimedPath& path) const {
  Ticks arrive = nodes_[node].arrive;
  path.arrival = arrive;
  path.moves.clear();
  for (; nodes_[node].parent != kNoParent; node = nodes_[node].parent) {
    const auto& [edge, first] = nodes_[node].move;
    const Ticks start = first + (arrive - nodes_[node].arrive);
    path.moves.push_back({edge, start});
    const Node& before = nodes_[nodes_[node].parent];
    arrive = before.stay == kPasses ? start : before.arrive;
  }
  std::reverse(path.moves.begin(), path.moves.end());
}

}  // namespace quadrille::continuous
