// SPDX-License-Identifier: MIT
#include "theory/path_replay.hpp"

#include <algorithm>

namespace quadrille::continuous {

PathReplay::PathReplay(const Instance& instance, AgentId agent, const std::vector<Ban>& bans)
    : instance_(instance), agent_(instance.agent(agent)), id_(agent), bans_(bans) {
  for (std::size_t v = 0; v < instance.roadmap().num_vertices(); ++v) {
    stays_.push_back(safe_stays(VertexId(v)));
    passings_.push_back({});
  }
  for (const Ban& ban : bans)
    for (const Ticks tick : {ban.when.begin, ban.when.end})
      if (tick < kForever - 1) constant_from_ = std::max(constant_from_, tick);
}

// As long as possible: one from each moment at which a ban ends, and from the start.
std::vector<PathReplay::SafeStay> PathReplay::safe_stays(VertexId v) const {
  std::vector<TickInterval> stretches;
  std::vector<Ticks> moments{0};
  for (const Ban& ban : bans_)
    if (ban.kind == Ban::Kind::stay && ban.place == v.value()) {
      stretches.push_back(ban.when);
      if (ban.when.end > 0) moments.push_back(ban.when.end);
    }
  std::vector<SafeStay> stays;
  for (const Ticks from : moments) {
    if (from >= kForever) continue;
    Ticks until = kForever;
    for (const TickInterval& s : stretches)
      if (s.end > from) until = std::min(until, s.begin);
    if (until >= from) stays.push_back({from, until});
  }
  return stays;
}

Ticks PathReplay::next_start(EdgeId e, Ticks tick) const {
  for (bool is_moved = true; is_moved;) {
    is_moved = false;
    for (const Ban& ban : bans_)
      if (ban.kind == Ban::Kind::start && ban.place == e.value() && ban.when.contains(tick)) {
        tick = ban.when.end;
        is_moved = true;
      }
  }
  return tick;
}

Ticks PathReplay::last_start(EdgeId e, Ticks tick) const {
  Ticks last = kForever;
  for (const Ban& ban : bans_)
    if (ban.kind == Ban::Kind::start && ban.place == e.value() && ban.when.begin > tick &&
        !ban.when.is_empty())
      last = std::min(last, ban.when.begin - 1);
  return last;
}

bool PathReplay::has_path(Ticks bound) {
  bound_ = agent_.deadline ? std::min(bound, *agent_.deadline + 1) : bound;
  for (std::size_t k = 0; k < stays_[agent_.start].size(); ++k)
    if (stays_[agent_.start][k].from == 0) reach(agent_.start, k, 0);
  while (!queue_.empty()) {
    const Place place = queue_.front();
    queue_.pop_front();
    const bool stays = instance_.roadmap().may_wait(place.vertex) && place.last >= kForever;
    if (agent_.goals.contains(place.vertex) && (agent_.leaves || stays)) return true;
    for (const EdgeId e : instance_.roadmap().out_edges(place.vertex))
      if (instance_.roadmap().edge(e).open_to.contains(agent_.group)) take(place, e);
  }
  return false;
}

void PathReplay::take(const Place& from, EdgeId e) {
  const VertexId w = instance_.roadmap().to(e);
  const Ticks duration = instance_.duration(instance_.class_of(id_), e);
  for (std::size_t l = 0; l < stays_[w].size(); ++l) {
    const SafeStay& stay = stays_[w][l];
    const Ticks last = std::min(from.last, stay.until - duration);
    Ticks s = next_start(e, std::max({from.first, stay.from - duration, agent_.release}));
    if (s >= kForever || s > last) continue;
    if (instance_.roadmap().may_wait(w)) {
      reach(w, l, s + duration);
      continue;
    }
    while (s <= last && s < kForever) {
      const Ticks end = std::min(last, last_start(e, s));
      pass(w, {s + duration, end + duration});
      s = next_start(e, end + 1);
    }
  }
}

void PathReplay::reach(VertexId v, std::size_t stay, Ticks arrival) {
  if (arrival >= bound_ || arrival >= stays_[v][stay].arrival) return;
  stays_[v][stay].arrival = arrival;
  queue_.push_back({v, stay, arrival, stays_[v][stay].until});
}

// Of arrivals when bans do not change any more the first one will do.
void PathReplay::pass(VertexId v, Passing passing) {
  if (passing.first >= bound_) return;
  passing.last = std::min(passing.last, bound_ - 1);
  passing.last = std::max(passing.first, std::min(passing.last, constant_from_));
  for (const Passing& known : passings_[v]) {
    if (known.first <= passing.first && passing.last <= known.last) return;
    if (constant_from_ <= known.first && known.first <= passing.first) return;
    if (constant_from_ <= known.last && known.last <= passing.first) return;
  }
  passings_[v].push_back(passing);
  queue_.push_back({v, 0, passing.first, passing.last});
}

}  // namespace quadrille::continuous
