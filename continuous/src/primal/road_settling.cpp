// SPDX-License-Identifier: MIT
#include "primal/road_settling.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "quadrille/pebbles/settling.hpp"

namespace quadrille::continuous {
namespace {

using pebbles::kNoLocal;
using pebbles::Local;

/// Both directions of a way between two vertices, open to everybody.
struct Lane {
  VertexId a, b;                   // a < b
  EdgeId edge;                     // one of them
  std::vector<VertexId> blockers;  // ascending, without a and b
  bool is_used = true;
};

/// A way between two vertices at which agents stand, along lanes between others.
struct Road {
  Local to = kNoLocal;
  std::vector<std::size_t> lanes;
};

class RoadGraph {
 public:
  RoadGraph(StandingBodies& bodies, std::int64_t most, std::int64_t& effort)
      : bodies_(bodies),
        instance_(bodies.scene().instance()),
        limits_(bodies.scene().limits()),
        start_(bodies),
        most_(most),
        effort_(effort),
        is_wanted_(instance_.roadmap().num_vertices(), false),
        is_kept_(instance_.roadmap().num_vertices(), true),
        lanes_at_(instance_.roadmap().num_vertices()) {
    for (const AgentId i : instance_.agent_ids()) {
      is_wanted_[start_.vertex_of(i)] = true;
      is_wanted_[instance_.agent(i).goal()] = true;
    }
  }

  [[nodiscard]] std::optional<std::vector<SerialMove>> settle(GivingWay giving_way) {
    choose_bodies();
    list_lanes();
    if (giving_way == GivingWay::vertices) drop_vertices();
    drop_lanes();
    list_roads();
    if (is_too_much()) return std::nullopt;
    std::vector<SerialMove> moves;
    IdVector<VertexId, bool> is_done(is_kept_.size(), false);
    for (const AgentId i : instance_.agent_ids()) {
      const VertexId at = start_.vertex_of(i);
      if (is_done[at]) continue;
      if (!settle_component(at, is_done, moves)) return std::nullopt;
    }
    return moves;
  }

 private:
  [[nodiscard]] bool is_too_much() const { return effort_ > most_; }

  /// What the largest disc is not in the way of, no smaller one is.
  void choose_bodies() {
    std::optional<ClassId> largest;
    std::vector<const geometry::Body*> polygons;
    for (const ClassId c : IdRange<ClassId>(instance_.num_classes())) {
      const geometry::Body& body = instance_.body(c);
      if (instance_.has_shapes()) {
        shapes_.push_back(c);
      } else if (std::holds_alternative<geometry::Disc>(body)) {
        if (!largest || instance_.reach(c) > instance_.reach(*largest)) largest = c;
      } else if (std::none_of(polygons.begin(), polygons.end(),
                              [&](const geometry::Body* other) { return *other == body; })) {
        polygons.push_back(&body);
        shapes_.push_back(c);
      }
    }
    if (largest) shapes_.push_back(*largest);
  }

  [[nodiscard]] std::optional<EdgeId> edge_of(ClassId c, VertexId from, VertexId to) {
    for (const EdgeId e : instance_.out_edges(c, from)) {
      ++effort_;
      if (instance_.roadmap().to(e) == to && bodies_.may_use(c, e)) return e;
    }
    return std::nullopt;
  }

  void list_lanes() {
    const Roadmap& roadmap = instance_.roadmap();
    for (const VertexId a : IdRange<VertexId>(roadmap.num_vertices())) {
      limits_.check();
      std::vector<VertexId> ends;
      for (const EdgeId e : roadmap.out_edges(a)) {
        const VertexId b = roadmap.to(e);
        if (b <= a || std::find(ends.begin(), ends.end(), b) != ends.end()) continue;
        ends.push_back(b);
        bool is_open = true;
        for (const ClassId c : IdRange<ClassId>(instance_.num_classes()))
          is_open = is_open && edge_of(c, a, b) && edge_of(c, b, a);
        if (!is_open) continue;
        lanes_at_[a].push_back(lanes_.size());
        lanes_at_[b].push_back(lanes_.size());
        lanes_.push_back({a, b, e, {}, true});
        find_blockers(lanes_.back());
      }
      if (is_too_much()) return;
    }
  }

  /// Whatever the bodies of who moves and who stands. Without shapes both directions sweep the
  /// same.
  void find_blockers(Lane& lane) {
    find_blockers(lane, lane.edge);
    if (!instance_.has_shapes()) return;
    for (const ClassId c : shapes_)
      for (const VertexId from : {lane.a, lane.b})
        if (const auto edge = edge_of(c, from, from == lane.a ? lane.b : lane.a))
          find_blockers(lane, *edge);
  }
  void find_blockers(Lane& lane, EdgeId edge) {
    for (const ClassId c : shapes_)
      for (const ClassId b : shapes_)
        for (const VertexId v : bodies_.scene().contacts().near_edge(c, edge, b).vertices) {
          if (v == lane.a || v == lane.b) continue;
          const auto at = std::lower_bound(lane.blockers.begin(), lane.blockers.end(), v);
          if (at != lane.blockers.end() && *at == v) continue;
          ++effort_;
          if (bodies_.block(c, edge, b, v)) lane.blockers.insert(at, v);
        }
  }

  [[nodiscard]] bool is_between_kept(const Lane& lane) const {
    return is_kept_[lane.a] && is_kept_[lane.b];
  }
  template <class Visit>
  void for_each_breach(const Visit& visit) {
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      ++effort_;
      if (!lanes_[k].is_used || !is_between_kept(lanes_[k])) continue;
      for (const VertexId v : lanes_[k].blockers)
        if (is_kept_[v]) visit(lanes_[k], v);
    }
  }

  /// Again and again the vertex that takes part in most breaches.
  void drop_vertices() {
    IdVector<VertexId, std::uint32_t> count(is_kept_.size(), 0);
    while (!is_too_much()) {
      limits_.check();
      count.assign(is_kept_.size(), 0);
      for_each_breach([&](const Lane& lane, VertexId v) {
        for (const VertexId w : {v, lane.a, lane.b})
          if (!is_wanted_[w]) ++count[w];
      });
      const auto most = std::max_element(count.begin(), count.end());
      if (most == count.end() || *most == 0) return;
      is_kept_[VertexId(static_cast<std::size_t>(most - count.begin()))] = false;
    }
  }

  void drop_lanes() {
    for_each_breach([](Lane& lane, VertexId) { lane.is_used = false; });
  }

  /// From each vertex that is kept, through others, to the next ones.
  void list_roads() {
    for (const VertexId v : IdRange<VertexId>(is_kept_.size())) {
      if (!is_kept_[v]) continue;
      number_of_[v] = static_cast<Local>(kept_.size());
      kept_.push_back(v);
    }
    roads_.resize(kept_.size());
    for (const VertexId v : kept_) {
      if (is_too_much()) return;
      list_roads_from(v);
    }
  }

  void list_roads_from(VertexId from) {
    limits_.check();
    std::map<VertexId, std::pair<VertexId, std::size_t>> before;  // the lane that led there
    std::vector<VertexId> queue{from};
    before[from] = {from, 0};
    std::vector<Road>& roads = roads_[number_of_[from]];
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const VertexId at = queue[head];
      for (const std::size_t k : lanes_at_[at]) {
        ++effort_;
        const Lane& lane = lanes_[k];
        const VertexId to = lane.a == at ? lane.b : lane.a;
        if (!lane.is_used || before.contains(to)) continue;
        if (!is_kept_[to]) {
          before[to] = {at, k};
          queue.push_back(to);
          continue;
        }
        Road road{number_of_[to], {k}};
        for (VertexId w = at; w != from; w = before[w].first)
          road.lanes.push_back(before[w].second);
        std::reverse(road.lanes.begin(), road.lanes.end());
        const bool is_clear = std::all_of(road.lanes.begin(), road.lanes.end(), [&](std::size_t l) {
          const auto& blockers = lanes_[l].blockers;
          return std::all_of(blockers.begin(), blockers.end(),
                             [&](VertexId v) { return !is_kept_[v] || v == from || v == to; });
        });
        if (!is_clear) continue;
        before[to] = {at, k};
        roads.push_back(std::move(road));
      }
    }
  }

  [[nodiscard]] const Road* road_between(Local u, Local v) const {
    const auto at = std::find_if(roads_[u].begin(), roads_[u].end(),
                                 [&](const Road& road) { return road.to == v; });
    return at == roads_[u].end() ? nullptr : &*at;
  }

  [[nodiscard]] bool settle_component(VertexId from, IdVector<VertexId, bool>& is_done,
                                      std::vector<SerialMove>& moves) {
    if (!is_kept_[from]) return false;
    std::vector<Local> members{number_of_[from]};
    std::map<Local, Local> numbers{{members.front(), 0}};
    std::vector<std::vector<Local>> neighbours;
    for (std::size_t head = 0; head < members.size(); ++head) {
      is_done[kept_[members[head]]] = true;
      neighbours.emplace_back();
      for (const Road& road : roads_[members[head]]) {
        // What was found from one end only is left out.
        if (road_between(road.to, members[head]) == nullptr) continue;
        const auto [at, is_new] = numbers.try_emplace(road.to, static_cast<Local>(members.size()));
        if (is_new) members.push_back(road.to);
        neighbours.back().push_back(at->second);
      }
    }
    std::vector<AgentId> agents;
    std::vector<Local> starts, goals;
    for (const AgentId i : instance_.agent_ids()) {
      const VertexId goal = instance_.agent(i).goal();
      const auto start = numbers.find(number_of_[start_.vertex_of(i)]);
      if (start == numbers.end()) continue;
      const auto end = numbers.find(number_of_[goal]);
      if (end == numbers.end() || !is_kept_[goal]) return false;
      // Bodies that do not cover their places may have the same one as a goal.
      if (std::find(goals.begin(), goals.end(), end->second) != goals.end()) return false;
      agents.push_back(i);
      starts.push_back(start->second);
      goals.push_back(end->second);
    }
    pebbles::Settling settling(pebbles::LocalGraph(neighbours), std::move(starts), std::move(goals),
                               pebbles::Rotations::forbidden);
    auto state = pebbles::Settling::State::working;
    while (state == pebbles::Settling::State::working) {
      limits_.check();
      state = settling.step(limits_);
      if (effort_ + settling.effort() > most_) return false;
    }
    effort_ += settling.effort();
    if (state == pebbles::Settling::State::given_up) return false;
    for (const pebbles::Shift& shift : settling.shifts())
      drive(agents[shift.agent], members[shift.from], members[shift.to], moves);
    return true;
  }

  void drive(AgentId agent, Local from, Local to, std::vector<SerialMove>& moves) {
    const ClassId c = instance_.class_of(agent);
    VertexId at = kept_[from];
    for (const std::size_t k : road_between(from, to)->lanes) {
      const Lane& lane = lanes_[k];
      const VertexId next = lane.a == at ? lane.b : lane.a;
      moves.push_back({agent, *edge_of(c, at, next)});
      at = next;
    }
  }

  StandingBodies& bodies_;
  const Instance& instance_;
  LimitMonitor& limits_;
  const Standing start_;
  const std::int64_t most_;
  std::int64_t& effort_;
  std::vector<ClassId> shapes_;
  IdVector<VertexId, bool> is_wanted_, is_kept_;
  std::vector<Lane> lanes_;
  IdVector<VertexId, std::vector<std::size_t>> lanes_at_;
  std::vector<VertexId> kept_;
  std::map<VertexId, Local> number_of_;
  std::vector<std::vector<Road>> roads_;  // by place in kept_
};

}  // namespace

std::optional<std::vector<SerialMove>> settle_on_roads(StandingBodies& bodies, GivingWay giving_way,
                                                       std::int64_t most, std::int64_t& effort) {
  const Instance& instance = bodies.scene().instance();
  // Who leaves makes room that boards know nothing of; two may even have the same goal.
  for (const Agent& agent : instance.agents())
    if (agent.leaves) return std::nullopt;
  return RoadGraph(bodies, most, effort).settle(giving_way);
}

}  // namespace quadrille::continuous
