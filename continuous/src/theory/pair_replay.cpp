// SPDX-License-Identifier: MIT
#include "theory/pair_replay.hpp"

#include <algorithm>

namespace quadrille::continuous {
namespace {

ShapePairs pairs_of(const Instance& instance, AgentId i, AgentId j) {
  return shape_pairs(instance, instance.class_of(i), instance.class_of(j));
}

}  // namespace

PairReplay::PairReplay(const Instance& instance, Party first, Party second)
    : instance_(instance),
      first_(std::move(first)),
      second_(std::move(second)),
      bodies_(pairs_of(instance, first_.agent, second_.agent)),
      swapped_(pairs_of(instance, second_.agent, first_.agent)),
      parked_(instance) {
  for (Party* party : {&first_, &second_})
    if (const auto& deadline = instance.agent(party->agent).deadline)
      party->bound = std::min(party->bound, *deadline + 1);
  fill_rest(first_);
  fill_rest(second_);
}

void PairReplay::fill_rest(Party& party) const {
  const Roadmap& roadmap = instance_.roadmap();
  party.rest.assign(roadmap.num_vertices(), kForever);
  party.rest[instance_.agent(party.agent).goal().index()] = 0;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::uint32_t e = 0; e < roadmap.num_edges(); ++e) {
      if (!may_use(party, e)) continue;
      const Edge& edge = roadmap.edge(EdgeId(e));
      const Ticks via = party.rest[edge.to.index()] + duration(party, e);
      if (via >= party.rest[edge.from.index()]) continue;
      party.rest[edge.from.index()] = via;
      is_changed = true;
    }
  }
}

std::optional<bool> PairReplay::has_plan(std::size_t max_states) {
  using Both = std::pair<State, State>;
  std::set<Both> now, next;
  const auto start = [&](const Party& party) {
    return State{Kind::stands, instance_.agent(party.agent).start.value(), 0};
  };
  const State a = start(first_), b = start(second_);
  if (may_be_at(first_, a.place, 0, 0) && may_be_at(second_, b.place, 0, 0)) now.insert({a, b});
  std::size_t num_states = 0;
  for (Ticks t = 0; !now.empty(); ++t) {
    num_states += now.size();
    if (num_states > max_states) return std::nullopt;
    next.clear();
    for (const auto& [x, y] : now) {
      if (x.kind == Kind::parks && y.kind == Kind::parks) return true;
      const std::vector<Step> steps_of_y = steps(second_, y, t);
      for (const Step& p : steps(first_, x, t))
        for (const Step& q : steps_of_y)
          if (!collide(p.during, q.during)) next.insert({p.after, q.after});
    }
    now.swap(next);
  }
  return false;
}

// What cannot park before its bound is left out.
std::vector<PairReplay::Step> PairReplay::steps(const Party& party, const State& state,
                                                Ticks now) const {
  std::vector<Step> result;
  if (state.kind == Kind::parks) return {{state, state}};
  const auto go_on = [&](std::uint32_t edge, Ticks progress) {
    const State during{Kind::moves, edge, progress};
    const VertexId end = instance_.roadmap().edge(EdgeId(edge)).to;
    if (now + duration(party, edge) - progress + party.rest[end.index()] >= party.bound) return;
    if (progress + 1 < duration(party, edge)) {
      result.push_back({during, {Kind::moves, edge, progress + 1}});
      return;
    }
    const std::uint32_t to = instance_.roadmap().edge(EdgeId(edge)).to.value();
    if (may_be_at(party, to, now + 1, now + 1)) result.push_back({during, {Kind::stands, to, 0}});
  };
  if (state.kind == Kind::moves) {
    go_on(state.place, state.progress);
    return result;
  }
  if (now + party.rest[state.place] >= party.bound) return result;
  const Agent& agent = instance_.agent(party.agent);
  const State parked{Kind::parks, state.place, 0};
  if (state.place == agent.goal().value() && agent.leaves) return {{parked, parked}};
  if (may_be_at(party, state.place, now, now + 1)) result.push_back({state, state});
  if (state.place == agent.goal().value() && may_be_at(party, state.place, now, kForever))
    result.push_back({state, parked});
  if (now < instance_.agent(party.agent).release) return result;
  // On purpose without the lists of open edges that the searches use.
  for (const EdgeId e : instance_.roadmap().out_edges(VertexId(state.place)))
    if (may_use(party, e.value()) &&
        std::none_of(party.bans.begin(), party.bans.end(), [&](const Ban& ban) {
          return ban.kind == Ban::Kind::start && ban.place == e.value() && ban.when.contains(now);
        }))
      go_on(e.value(), 0);
  return result;
}

bool PairReplay::may_be_at(const Party& party, std::uint32_t vertex, Ticks from, Ticks to) const {
  return std::none_of(party.bans.begin(), party.bans.end(), [&](const Ban& ban) {
    return ban.kind == Ban::Kind::stay && ban.place == vertex && ban.when.meets(from, to);
  });
}

// A move is looked at as a whole: the two collide, if not now, then later or before.
bool PairReplay::collide(const State& a, const State& b) {
  const auto stand = [&](const State& s) {
    return stand_at(instance_.roadmap(), VertexId(s.place));
  };
  const auto rest = [&](const State& s) { return rest_at(instance_.roadmap(), VertexId(s.place)); };
  const auto move = [&](const Party& party, const State& s) {
    return move_of(instance_, instance_.class_of(party.agent), EdgeId(s.place));
  };
  const auto is_gone = [&](const Party& party, const State& s) {
    return s.kind == Kind::parks && instance_.agent(party.agent).leaves;
  };
  if (is_gone(first_, a) || is_gone(second_, b)) return false;
  const bool a_moves = a.kind == Kind::moves, b_moves = b.kind == Kind::moves;
  if (a_moves && b_moves)
    return bodies_.collide(move(first_, a), move(second_, b), a.progress - b.progress);
  if (a_moves && parked_.may_move(EdgeId(a.place), VertexId(b.place), bodies_)) return false;
  if (b_moves && parked_.may_move(EdgeId(b.place), VertexId(a.place), swapped_)) return false;
  if (a_moves) return bodies_.collide(move(first_, a), rest(b), a.progress);
  if (b_moves) return swapped_.collide(move(second_, b), rest(a), b.progress);
  return !parked_.may_stand(VertexId(a.place), VertexId(b.place)) &&
         bodies_.overlap(stand(a), stand(b));
}

bool PairReplay::may_use(const Party& party, std::uint32_t edge) const {
  return instance_.roadmap()
      .edge(EdgeId(edge))
      .open_to.contains(instance_.agent(party.agent).group);
}

Ticks PairReplay::duration(const Party& party, std::uint32_t edge) const {
  return instance_.duration(instance_.class_of(party.agent), EdgeId(edge));
}

}  // namespace quadrille::continuous
