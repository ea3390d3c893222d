// SPDX-License-Identifier: MIT
//
// What PairSearch knows of one agent, and which of it matters to the other.
#include <algorithm>
#include <queue>
#include <utility>

#include "pairs/pair_search.hpp"

namespace quadrille::continuous {
namespace {

constexpr std::size_t kMaxEdges = 50'000;
/// At the limits, while contacts are looked for: a millisecond or less.
constexpr std::int64_t kLooksPerCheck = 20'000;

}  // namespace

bool PairSearch::collect_edges(const Party& party, Ticks raise, const Party& other,
                               Ticks other_raise, Side& side) {
  const Instance& instance = scene_.instance();
  const Roadmap& roadmap = instance.roadmap();
  side.agent = party.agent;
  side.c = instance.class_of(party.agent);
  side.cap = party.cap;
  side.slack = party.cap + raise - as_ticks(scene_.free_cost(party.agent));
  for (const VertexId v : side.reached) side.from_start[v.index()] = kForever;
  side.reached.clear();
  side.edges.clear();
  if (side.from_start.empty()) {
    side.from_start.assign(roadmap.num_vertices(), kForever);
    for (auto* table : {&side.first_edge, &side.end_edge, &side.first_element, &side.end_element})
      table->resize(roadmap.num_vertices());
    side.distance.assign(roadmap.num_vertices(), kForever);
    side.next.resize(roadmap.num_vertices());
    side.stay_matters.resize(roadmap.num_vertices());
    side.may_matter_later.resize(roadmap.num_vertices());
  }
  const auto& distances = scene_.task(party.agent).distances;
  const ClassId other_class = instance.class_of(other.agent);
  const VertexId other_goal = instance.agent(other.agent).goal();
  const Length reach_of_bodies = instance.reach(side.c) + instance.reach(other_class);
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](VertexId v, Ticks ticks) {
    Ticks& known = side.from_start[v.index()];
    if (ticks >= known) return;
    if (known == kForever) {
      side.reached.push_back(v);
      side.first_edge[v.index()] = side.end_edge[v.index()] = 0;
      side.stay_matters[v.index()] = 0;
    }
    known = ticks;
    queue.emplace(ticks, v);
  };
  const Agent& agent = instance.agent(party.agent);
  side.release = agent.start == agent.goal() ? Ticks{0} : agent.release;
  reach(agent.start, agent.release);
  while (!queue.empty()) {
    const auto [ticks, v] = queue.top();
    queue.pop();
    if (ticks > side.from_start[v.index()]) continue;
    side.first_edge[v.index()] = side.end_edge[v.index()] =
        static_cast<std::uint32_t>(side.edges.size());
    if (agent.leaves && v == agent.goal()) continue;
    for (const EdgeId e : instance.out_edges(side.c, v)) {
      const Ticks rest = distances[roadmap.to(e)], duration = instance.duration(side.c, e);
      if (rest >= kForever) continue;
      const Ticks by_cap = party.cap - rest - duration;
      TimedEdge edge{e, ticks, by_cap + raise, by_cap};
      // From its cap on at the latest the other one stands at its goal, unless it leaves.
      const auto w = instance.agent(other.agent).leaves
                         ? std::nullopt
                         : window(side.c, e, other_class, other_goal, reach_of_bodies);
      if (w) {
        const Ticks by_goal = other.cap - w->end;
        edge.last = std::min(edge.last, by_goal + other_raise);
        edge.last_without_raise = std::min(edge.last_without_raise, by_goal);
      }
      if (edge.last < ticks) continue;
      side.edges.push_back(edge);
      reach(roadmap.to(e), ticks + duration);
    }
    side.end_edge[v.index()] = static_cast<std::uint32_t>(side.edges.size());
    if (side.edges.size() > kMaxEdges) return false;
  }
  return true;
}

Ticks PairSearch::leave_by(const Side& side, VertexId v) const {
  const Agent& agent = scene_.instance().agent(side.agent);
  if (v == agent.goal()) return agent.leaves ? -kForever : kForever;
  Ticks last = -1;
  for (auto k = side.first_edge[v.index()]; k < side.end_edge[v.index()]; ++k)
    last = std::max(last, side.edges[k].last);
  return last;
}

void PairSearch::fill_grids(const Side& y, Length reach) {
  listed_.clear();
  for (const TimedEdge& e : y.edges) listed_.push_back(boxes_[e.edge.index()]);
  edge_grid_.fill(listed_, reach);
  listed_.clear();
  for (const VertexId v : y.reached) listed_.push_back(box(v));
  place_grid_.fill(listed_, reach);
}

/// Marks the edges of x and y that could collide, and the edges of x and stays of y. Looks at what
/// y can do only: of the edges of the roadmap that are near (Contacts::near_edge) it may be few.
bool PairSearch::find_contacts(Side& x, Side& y) {
  const Instance& instance = scene_.instance();
  const Length reach = instance.reach(x.c) + instance.reach(y.c);
  fill_grids(y, reach);
  std::int64_t next_check = num_looks() + kLooksPerCheck;
  for (TimedEdge& e : x.edges) {
    if (num_looks() >= next_check) {
      if (scene_.limits().exhausted_now()) return false;
      next_check = num_looks() + kLooksPerCheck;
    }
    const Ticks duration = instance.duration(x.c, e.edge);
    edge_grid_.visit_near(boxes_[e.edge.index()], reach, [&](std::uint32_t k) {
      TimedEdge& other = y.edges[k];
      if (e.may_collide && other.may_collide) return;
      const Ticks least = other.first - e.last, most = other.last - e.first;
      if (least > duration || most < -instance.duration(y.c, other.edge)) return;
      const auto offsets = scene_.contacts().offsets(x.c, e.edge, y.c, other.edge);
      if (offsets && offsets->overlaps(TickInterval::closed(least, most)))
        e.may_collide = other.may_collide = true;
    });
    place_grid_.visit_near(boxes_[e.edge.index()], reach, [&](std::uint32_t k) {
      const VertexId v = y.reached[k];
      // Released late or not, it is at its start from tick 0 on.
      const Ticks arrive = v == instance.agent(y.agent).start ? Ticks{0} : y.from_start[v.index()];
      if (arrive > e.last + duration) return;
      const auto w = scene_.contacts().window(x.c, e.edge, y.c, v);
      if (w && arrive < e.last + w->end && leave_by(y, v) > e.first + w->begin) {
        e.may_collide = true;
        y.stay_matters[v.index()] = 1;
      }
    });
  }
  return true;
}

void PairSearch::list_allowed(const Side& side, const TimedEdge& e) {
  BanTable& bans = *side.bans;
  const Edge& edge = scene_.instance().roadmap().edge(e.edge);
  forbidden_.clear();
  if (const auto place = bans.starts_of(e.edge); place != BanTable::kFree)
    forbidden_ = bans.forbidden_starts(place);
  // Who is at a vertex strictly between begin and end breaks the ban: so does who sets out then, or
  // arrives.
  const auto add_stays = [&](VertexId v, Ticks after) {
    const auto place = bans.stays_of(v);
    if (place == BanTable::kFree) return;
    for (const BanTable::Entry& entry : bans.entries(place))
      if (bans.is_enabled(entry.slot) && !entry.when.inner_ticks().is_empty())
        forbidden_.push_back(entry.when.inner_ticks().shifted(-after));
  };
  add_stays(edge.from, 0);
  add_stays(edge.to, scene_.instance().duration(side.c, e.edge));
  std::sort(forbidden_.begin(), forbidden_.end(),
            [](const auto& a, const auto& b) { return a.begin < b.begin; });
  allowed_.clear();
  Ticks from = e.first;
  for (const TickInterval& starts : forbidden_) {
    if (starts.begin > from) allowed_.push_back({from, std::min(starts.begin, e.last + 1)});
    from = std::max(from, starts.end);
    if (from > e.last) return;
  }
  allowed_.push_back(TickInterval::closed(from, e.last));
}

// As no allowed move arrives or sets out during a ban, a stay breaks one only if it lasts from
// before until after it; and that is the same for all starts of the two elements.
bool PairSearch::breaks_ban(const Side& side, const Element& from, const Element& to) {
  const auto place = side.bans->stays_of(from.to);
  if (place == BanTable::kFree) return false;
  const auto& entries = side.bans->entries(place);
  return std::any_of(entries.begin(), entries.end(), [&](const BanTable::Entry& entry) {
    return side.bans->is_enabled(entry.slot) && from.last + from.duration <= entry.when.begin &&
           to.first >= entry.when.end;
  });
}

bool PairSearch::is_banned(BanTable& bans, EdgeId e) const {
  const Edge& edge = scene_.instance().roadmap().edge(e);
  return bans.starts_of(e) != BanTable::kFree || bans.stays_of(edge.from) != BanTable::kFree ||
         bans.stays_of(edge.to) != BanTable::kFree;
}

Ticks PairSearch::width_of(const Side& side) const {
  return std::max<Ticks>(std::min<Ticks>((side.slack + Ticks(1)) / 2, width_), 1);
}

void PairSearch::make_elements(Side& side) {
  const Instance& instance = scene_.instance();
  const Roadmap& roadmap = instance.roadmap();
  const VertexId start = instance.agent(side.agent).start;
  side.elements.clear();
  const Ticks width = width_of(side);
  for (const VertexId v : side.reached) {
    side.next[v.index()].is_known = false;
    side.may_matter_later[v.index()] = 0;
  }
  side.elements.push_back(
      {false, true, side.stay_matters[start.index()] != 0, EdgeId(), start, 0, 0, 0, 0});
  side.elements.push_back(
      {false, true, false, EdgeId(), instance.agent(side.agent).goal(), 0, kForever, 0, kForever});
  for (const VertexId v : side.reached) {
    side.first_element[v.index()] = static_cast<std::uint32_t>(side.elements.size());
    for (auto k = side.first_edge[v.index()]; k < side.end_edge[v.index()]; ++k) {
      TimedEdge& e = side.edges[k];
      const VertexId to = roadmap.edge(e.edge).to;
      const bool stay_matters = side.stay_matters[to.index()] != 0;
      e.matters = e.may_collide || stay_matters || side.stay_matters[v.index()] != 0 ||
                  is_banned(*side.bans, e.edge);
      const Ticks duration = instance.duration(side.c, e.edge);
      list_allowed(side, e);
      // The earliest start is by itself.
      for (const TickInterval& starts : allowed_)
        for (Ticks first = starts.first(), last = first; first <= starts.last();
             first = last + 1, last = std::min(first + width - 1, starts.last()))
          side.elements.push_back({true, e.matters, stay_matters, e.edge, to, first, last, duration,
                                   e.last_without_raise});
      if (e.matters && side.may_matter_later[v.index()] == 0) {
        side.may_matter_later[v.index()] = 1;
        stack_.push_back(v.value());
      }
    }
    side.end_element[v.index()] = static_cast<std::uint32_t>(side.elements.size());
  }
  while (!stack_.empty()) {
    const VertexId v(stack_.back());
    stack_.pop_back();
    for (const EdgeId e : instance.in_edges(side.c, v)) {
      const VertexId u = roadmap.from(e);
      if (side.from_start[u.index()] >= kForever || side.may_matter_later[u.index()] != 0) continue;
      side.may_matter_later[u.index()] = 1;
      stack_.push_back(u.value());
    }
  }
}

Ticks PairSearch::raise_for_end(const Element& element, Ticks tick) {
  if (tick > element.last) return kForever;
  return std::max<Ticks>(0, tick - element.last_without_raise);
}

const PairSearch::Next& PairSearch::next_of(Side& side, VertexId from) {
  Next& next = side.next[from.index()];
  if (next.is_known) return next;
  next = {};
  next.is_known = true;
  const Instance& instance = scene_.instance();
  const auto& rest = scene_.task(side.agent).distances;
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<VertexId> seen;
  const auto reach = [&](VertexId v, Ticks ticks) {
    Ticks& known = side.distance[v.index()];
    if (ticks >= known) return;
    if (known == kForever) seen.push_back(v);
    known = ticks;
    queue.emplace(ticks, v);
  };
  reach(from, 0);
  while (!queue.empty()) {
    const auto [ticks, v] = queue.top();
    queue.pop();
    if (ticks > side.distance[v.index()]) continue;
    const bool is_end = side.may_matter_later[v.index()] == 0;
    if (is_end || rest[v] == 0) next.done = std::min(next.done, ticks + rest[v]);
    if (is_end) continue;
    bool matters = false;
    for (auto k = side.first_edge[v.index()]; k < side.end_edge[v.index()]; ++k) {
      const TimedEdge& e = side.edges[k];
      const Ticks start = side.from_start[from.index()] + ticks;
      if (start > e.last) continue;
      if (e.matters) {
        matters = true;
        next.begin_by = std::max(next.begin_by, e.last);
        next.begin_by_without_raise = std::max(next.begin_by_without_raise, e.last_without_raise);
      } else {
        reach(instance.roadmap().edge(e.edge).to, ticks + instance.duration(side.c, e.edge));
      }
    }
    if (matters) next.ways.push_back({v, ticks});
  }
  for (const VertexId v : seen) side.distance[v.index()] = kForever;
  return next;
}

Ticks PairSearch::raise_for_done(const Side& side, const Element& element, Ticks start,
                                 const Next& next) {
  if (next.done >= kForever) return kForever;
  const Ticks wait = element.is_move ? Ticks{0} : side.release;
  return std::max<Ticks>(0, start + element.duration + wait + next.done - side.cap);
}

Ticks PairSearch::raise_to_wait(Side& side, const Element& element, Ticks start, Ticks tick) {
  const Next& next = next_of(side, element.to);
  const Ticks done = raise_for_done(side, element, start, next);
  if (tick > next.begin_by) return done;
  return std::min(done, std::max<Ticks>(0, tick - next.begin_by_without_raise));
}

}  // namespace quadrille::continuous
