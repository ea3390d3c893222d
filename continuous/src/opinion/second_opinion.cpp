// SPDX-License-Identifier: MIT
//
// On purpose this uses nothing of `verify`.
#include "quadrille/continuous/second_opinion.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace quadrille::continuous {
namespace {

using geometry::Encounter;
using geometry::EncounterCheck;
using geometry::Leg;

/// Which rule a path breaks; empty if none.
std::string find_fault(const Instance& instance, AgentId i, const Path& path) {
  const Roadmap& roadmap = instance.roadmap();
  const Agent& agent = instance.agent(i);
  if (path.empty()) return "has no stops";
  const auto is_known = [&](const Stop& stop) {
    return stop.vertex.index() < roadmap.num_vertices();
  };
  if (!std::all_of(path.begin(), path.end(), is_known)) return "names a vertex that is none";
  if (path.front().vertex != agent.start) return "does not begin at its start";
  if (!agent.goals.contains(path.back().vertex)) return "does not end at its goal";
  if (path.front().arrive != instance.now())
    return "does not begin at tick " + std::to_string(instance.now().value());
  if (path.back().depart != path.back().arrive || path.back().arrive > kMaxTick)
    return "does not end with an arrival in time";
  if (agent.deadline && path.back().arrive > *agent.deadline) return "misses its deadline";
  if (agent.under_way && path.front().depart > instance.now())
    return "stops in the middle of a move";
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (path[k].depart < path[k].arrive) return "departs before it arrives";
    if (path[k].depart > path[k].arrive && !roadmap.may_wait(path[k].vertex))
      return "waits at vertex " + std::to_string(path[k].vertex.index()) + ", where nobody may";
    if (k + 1 == path.size()) break;
    const Ticks takes = path[k + 1].arrive - path[k].depart;
    const auto& edges = roadmap.edges();
    const auto takes_it = [&](EdgeId e) {
      return edges[e.index()].to == path[k + 1].vertex &&
             edges[e.index()].open_to.contains(agent.group) &&
             instance.duration(instance.class_of(i), e) == takes;
    };
    const auto out = roadmap.out_edges(path[k].vertex);
    if (std::none_of(out.begin(), out.end(), takes_it))
      return "makes a move that no edge allows it, from vertex " +
             std::to_string(path[k].vertex.index()) + " at tick " +
             std::to_string(path[k].depart.value());
    if (path[k].depart < agent.release) return "departs before its release";
  }
  return "";
}

/// From a place, which may be in the middle of a move, to a vertex.
Leg way(const geometry::Place& from, const geometry::Place& to, Ticks begin, Ticks end) {
  if (from.from == from.to) return {from.from, to.from, begin, end};
  return {from.from, to.from, begin, end, from.behind, from.whole};
}

/// Where a body is as long as it is anywhere, leg after leg; if it stays, until `horizon`.
template <class Stops, class Place>
std::vector<Leg> legs_of(const Stops& stops, const Place& place, bool leaves, Ticks horizon) {
  std::vector<Leg> legs;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const geometry::Place here = place(stops[k]);
    if (k > 0) legs.push_back(way(place(stops[k - 1]), here, stops[k - 1].depart, stops[k].arrive));
    const bool stays = k + 1 == stops.size() && !leaves;
    const Ticks until = stays ? horizon : stops[k].depart;
    // Passing through a place belongs to the moves before and after it; what is somewhere for one
    // moment of its life is in nobody's way, docs/continuous.md.
    if (until <= stops[k].arrive) continue;
    legs.push_back({here.from, here.to, stops[k].arrive, until, 0, 0, /*stands=*/true});
    if (here.from == here.to) continue;
    legs.back().behind = here.behind;
    legs.back().whole = here.whole;
  }
  return legs;
}

/// Whether the leg is a stay where the agent begins, or its first move.
bool is_first(const std::vector<Leg>& legs, std::size_t k) {
  return k == 0 || (k == 1 && legs[0].stands);
}

class Opinion {
 public:
  Opinion(const Instance& instance, const Plan& plan) : instance_(instance), plan_(plan) {
    for (const Point& p : instance.roadmap().positions()) include(p);
    for (const MovingObstacle& obstacle : instance.obstacles())
      for (const MovingObstacle::Stop& stop : obstacle.path) {
        include(stop.at);
        horizon_ = std::max(horizon_, stop.depart + 1);
      }
  }

  SecondOpinion run() {
    check_paths();
    for (const MovingObstacle& obstacle : instance_.obstacles())
      obstacles_.push_back(legs_of(
          obstacle.path, [](const MovingObstacle::Stop& stop) { return geometry::Place(stop.at); },
          obstacle.leaves, horizon_));
    for (const AgentId i : instance_.agent_ids()) {
      for (const AgentId j : instance_.agent_ids())
        if (i < j) compare({i, j, {}}, legs_[i], legs_[j]);
      for (std::size_t o = 0; o < obstacles_.size(); ++o)
        compare({i, {}, o}, legs_[i], obstacles_[o]);
    }
    const auto collides = [](const Meeting& meeting) { return meeting.collide; };
    using Verdict = SecondOpinion::Verdict;
    if (!opinion_.broken.empty())
      opinion_.verdict = Verdict::broken;
    else if (std::any_of(opinion_.meetings.begin(), opinion_.meetings.end(), collides))
      opinion_.verdict = Verdict::collision;
    else if (!opinion_.meetings.empty())
      opinion_.verdict = Verdict::touch;
    return std::move(opinion_);
  }

 private:
  void include(const Point& p) {
    for (const Length coordinate : {p.x, p.y, p.z}) extent_ = std::max(extent_, abs(coordinate));
  }

  /// Paths without fault as legs.
  void check_paths() {
    std::vector<AgentId> sound;
    for (const AgentId i : instance_.agent_ids()) {
      const std::string fault = find_fault(instance_, i, plan_.paths[i]);
      if (fault.empty()) {
        sound.push_back(i);
        horizon_ = std::max(horizon_, plan_.paths[i].back().arrive + 1);
      } else {
        opinion_.broken.push_back("the path of agent " + std::to_string(i.index()) + " " + fault);
      }
    }
    legs_ = IdVector<AgentId, std::vector<Leg>>(instance_.num_agents());
    looks_ = IdVector<AgentId, std::vector<ShapeId>>(instance_.num_agents());
    const auto place = [&](const Stop& stop) { return instance_.roadmap().place(stop.vertex); };
    for (const AgentId i : sound) {
      legs_[i] = legs_of(plan_.paths[i], place, instance_.agent(i).leaves, horizon_);
      if (!instance_.agent(i).shapes.empty()) add_looks(i);
    }
  }

  /// Whoever has left a stop by the begin of a leg moves on it.
  void add_looks(AgentId i) {
    const Roadmap& roadmap = instance_.roadmap();
    const Path& path = plan_.paths[i];
    std::size_t k = 0;
    for (const Leg& leg : legs_[i]) {
      while (k + 1 < path.size() && path[k + 1].arrive <= leg.begin) ++k;
      const bool stands = leg.begin < path[k].depart || k + 1 == path.size();
      looks_[i].push_back(stands ? roadmap.shape(path[k].vertex)
                                 : roadmap.shape(path[k].vertex, path[k + 1].vertex));
    }
  }

  /// The body of an agent on its leg, and what tells it from others.
  struct Look {
    const Body* body;
    std::pair<std::size_t, ShapeId> key;
  };
  [[nodiscard]] Look look_of(AgentId i, std::size_t leg) const {
    return look_as(i, looks_[i].empty() ? ShapeId() : looks_[i][leg]);
  }
  [[nodiscard]] Look look_as(AgentId i, ShapeId shape) const {
    return {&instance_.agent(i).body_as(shape), {instance_.class_of(i).index(), shape}};
  }
  [[nodiscard]] Look other_look(const Meeting& meeting, std::size_t leg) const {
    if (meeting.other) return look_of(*meeting.other, leg);
    return {&instance_.obstacles()[*meeting.obstacle].body,
            {instance_.num_classes() + *meeting.obstacle, ShapeId()}};
  }

  const EncounterCheck& between(const Look& a, const Look& b) {
    const std::pair key(a.key, b.key);
    const auto known = checks_.find(key);
    if (known != checks_.end()) return known->second;
    EncounterCheck check(*a.body, *b.body, extent_);
    opinion_.tolerance = std::max(opinion_.tolerance, check.tolerance());
    return checks_.emplace(key, std::move(check)).first->second;
  }

  /// Of two who overlap at their starts, where one of them stands: both do, or they are apart when
  /// the other one's move ends.
  static bool part(const EncounterCheck& check, const Leg& a, const Leg& b) {
    if (a.stands == b.stands) return a.stands;
    const auto at_end = [](const Leg& leg) {
      Leg rest = leg.stands ? leg : Leg{leg.to, leg.to, 0, 1};
      rest.begin = 0;
      rest.end = 1;
      return rest;
    };
    return check.look(at_end(a), at_end(b)) != Encounter::collision;
  }

  void compare(Meeting meeting, const std::vector<Leg>& a, const std::vector<Leg>& b) {
    const bool has_looks =
        !looks_[meeting.agent].empty() || (meeting.other && !looks_[*meeting.other].empty());
    const auto& parked = instance_.parked_pairs();
    const bool is_parked =
        meeting.other &&
        std::binary_search(parked.begin(), parked.end(), std::pair(meeting.agent, *meeting.other));
    std::size_t first = 0;  // of b: those before it end before the leg of a begins
    bool meets = false;
    for (std::size_t l = 0; l < a.size(); ++l) {
      const Leg& leg = a[l];
      while (first < b.size() && b[first].end < leg.begin) ++first;
      for (std::size_t k = first; k < b.size() && b[k].begin <= leg.end; ++k) {
        Look look = look_of(meeting.agent, l);
        Leg here = leg;
        if (has_looks && std::max(leg.begin, b[k].begin) >= std::min(leg.end, b[k].end)) {
          // Who changes its shape has neither at the one moment between. What appears where an
          // agent with shapes leaves meets the shape of the vertex.
          if (meeting.other || l + 1 < a.size() || k > 0 || b[k].begin != leg.end) continue;
          const VertexId last = plan_.paths[meeting.agent].back().vertex;
          look = look_as(meeting.agent, instance_.roadmap().shape(last));
          here = {leg.to, leg.to, leg.end - 1, leg.end, 0, 0, /*stands=*/true};
        }
        ++opinion_.num_looks;
        const EncounterCheck& check = between(look, other_look(meeting, k));
        if (is_parked && is_first(a, l) && is_first(b, k) && part(check, leg, b[k])) continue;
        const Encounter encounter = check.look(here, b[k]);
        if (encounter == Encounter::clear || (meets && encounter == Encounter::touch)) continue;
        meets = true;
        meeting.collide = encounter == Encounter::collision;
        meeting.begin = std::max(leg.begin, b[k].begin);
        meeting.end = std::min(leg.end, b[k].end);
        if (meeting.collide) {
          opinion_.meetings.push_back(meeting);
          return;
        }
      }
    }
    if (meets) opinion_.meetings.push_back(meeting);
  }

  const Instance& instance_;
  const Plan& plan_;
  Length extent_ = 0;
  Ticks horizon_ = 1;
  IdVector<AgentId, std::vector<Leg>> legs_;  // none: the path has a fault
  std::vector<std::vector<Leg>> obstacles_;
  IdVector<AgentId, std::vector<ShapeId>> looks_;  // of the legs; empty: the agent has no shapes
  using Key = std::pair<std::size_t, ShapeId>;
  std::map<std::pair<Key, Key>, EncounterCheck> checks_;
  SecondOpinion opinion_;
};

}  // namespace

std::string_view to_string(SecondOpinion::Verdict verdict) noexcept {
  switch (verdict) {
    case SecondOpinion::Verdict::clear:
      return "clear";
    case SecondOpinion::Verdict::touch:
      return "touch";
    case SecondOpinion::Verdict::collision:
      return "collision";
    case SecondOpinion::Verdict::broken:
      return "broken";
  }
  return "";
}

SecondOpinion ask_fcl(const Instance& instance, const Plan& plan) {
  if (plan.paths.size() == instance.num_agents()) return Opinion(instance, plan).run();
  SecondOpinion opinion;
  opinion.verdict = SecondOpinion::Verdict::broken;
  opinion.broken.push_back("the plan has " + std::to_string(plan.paths.size()) + " paths for " +
                           std::to_string(instance.num_agents()) + " agents");
  return opinion;
}

std::string find_contradiction(bool is_valid, const SecondOpinion& opinion) {
  using Verdict = SecondOpinion::Verdict;
  if (is_valid && opinion.verdict == Verdict::broken)
    return "the paths break no rule, but to the second verifier " + opinion.broken.front();
  if (is_valid && opinion.verdict == Verdict::collision)
    return "nobody collides, but FCL finds a collision";
  if (!is_valid && opinion.verdict == Verdict::clear)
    return "the plan breaks a rule, but FCL finds it clear";
  return "";
}

}  // namespace quadrille::continuous
