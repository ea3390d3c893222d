// SPDX-License-Identifier: MIT
#include "certificate/pair_contacts.hpp"

#include <functional>
#include <queue>
#include <utility>

namespace quadrille::continuous {

// A limit that has ended the search does not end the writing.
PairContacts::PairContacts(Scene& scene)
    : scene_(scene), unlimited_(Limits()), contacts_(scene.instance(), unlimited_) {}

void PairContacts::write(const Party& i, const Party& j, sat::CertificateWriter& writer) {
  const Reach x = reach(i), y = reach(j);
  write_side(x, y, true, writer);
  write_side(y, x, false, writer);
}

PairContacts::Reach PairContacts::reach(const Party& party) {
  const Instance& instance = scene_.instance();
  const Roadmap& roadmap = instance.roadmap();
  const Agent& agent = instance.agent(party.agent);
  const ClassId c = instance.class_of(party.agent);
  const GoalDistances& rest = scene_.task(party.agent).distances;
  Reach reach{party.agent,
              {},
              std::vector<std::size_t>(roadmap.num_edges(), kNone),
              std::vector<Ticks>(roadmap.num_vertices(), kForever)};
  using Entry = std::pair<Ticks, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto visit = [&](VertexId v, Ticks time) {
    if (time >= reach.arrivals[v.index()]) return;
    reach.arrivals[v.index()] = time;
    queue.emplace(time, v);
  };
  visit(agent.start, agent.release);
  while (!queue.empty()) {
    const auto [time, v] = queue.top();
    queue.pop();
    if (time > reach.arrivals[v.index()]) continue;
    for (const EdgeId e : instance.out_edges(c, v)) {
      const VertexId to = roadmap.to(e);
      const Ticks duration = instance.duration(c, e);
      if (rest[to] >= kForever) continue;
      const Ticks last = as_ticks(party.most) - duration - rest[to];
      if (last < time) continue;
      reach.places[e.index()] = reach.moves.size();
      reach.moves.push_back({e, time, last, duration});
      visit(to, time + duration);
    }
  }
  // It is at its start from tick 0 on, released late or not.
  reach.arrivals[agent.start.index()] = 0;
  return reach;
}

bool PairContacts::is_new(ClassId a, EdgeId e, ClassId b, bool is_stay, std::size_t place) {
  return written_.emplace(a, e, b, is_stay, place).second;
}

// Of two moves one side is enough.
void PairContacts::write_side(const Reach& x, const Reach& y, bool is_first,
                              sat::CertificateWriter& writer) {
  const Instance& instance = scene_.instance();
  const ClassId a = instance.class_of(x.agent), b = instance.class_of(y.agent);
  const auto put = [&](const Move& move, bool is_stay, std::size_t place,
                       const geometry::TickInterval& when) {
    writer.record('m', {sat::ProofMeanings::agent_number(x.agent),
                        static_cast<std::int64_t>(move.edge.index()),
                        sat::ProofMeanings::agent_number(y.agent), is_stay ? 1 : 0,
                        static_cast<std::int64_t>(place), when.begin.value(), when.end.value()});
  };
  for (const Move& move : x.moves) {
    const Contacts::Neighbours& near = contacts_.near_edge(a, move.edge, b);
    for (const EdgeId f : near.edges) {
      if (!is_first || y.places[f.index()] == kNone) continue;
      const Move& other = y.moves[y.places[f.index()]];
      const auto offsets = contacts_.offsets(a, move.edge, b, f);
      if (offsets &&
          offsets->overlaps(
              geometry::TickInterval::closed(other.first - move.last, other.last - move.first)) &&
          is_new(a, move.edge, b, false, f.index()))
        put(move, false, f.index(), *offsets);
    }
    for (const VertexId v : near.vertices) {
      if (y.arrivals[v.index()] >= kForever) continue;
      const auto window = contacts_.window(a, move.edge, b, v);
      if (window && y.arrivals[v.index()] < move.last + window->end &&
          is_new(a, move.edge, b, true, v.index()))
        put(move, true, v.index(), *window);
    }
  }
}

}  // namespace quadrille::continuous
