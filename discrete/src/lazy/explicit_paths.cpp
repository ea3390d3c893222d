// SPDX-License-Identifier: MIT
#include "lazy/explicit_paths.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>

#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

using sat::Lit;

class ExplicitPaths::AgentFormula final : public MddPaths::Formula {
 public:
  AgentFormula(LazyModel& model, AgentId agent, FormulaWriter& writer)
      : model_(model), agent_(agent), writer_(writer) {}
  Lit new_vertex(VertexId v, Timestep t) override {
    return model_.new_vertex(agent_, {v, t}, writer_);
  }
  Lit delay_at_least(Timestep delay) override {
    const AgentDistances& d = model_.distances(agent_);
    const Timestep cost = d.length() + delay;
    if (cost > d.free_cost()) return model_.cost_above(agent_, cost - 1, writer_);
    // Nobody costs less: a literal that is true.
    const Lit truth = model_.new_vertex(agent_, {d.start_state(), 0}, writer_);
    add(std::span(&truth, 1));
    return truth;
  }
  void add(std::span<const Lit> clause) override {
    writer_.add({sat::why::ExplicitPath{agent_}, clause, {}, false});
  }
  bool charges_delays() const override { return true; }

 private:
  LazyModel& model_;
  AgentId agent_;
  FormulaWriter& writer_;
};

std::int64_t ExplicitPaths::size(AgentId agent, Timestep max_delay) const {
  const AgentDistances& d = model_.distances(agent);
  std::int64_t size = 0;
  for (const VertexId v : IdRange<VertexId>(d.states().num_vertices())) {
    if (d.from_start(v) == kUnreachable) continue;
    if (d.to_goal(v) == kUnreachable) continue;
    const Timestep slack = d.from_start(v) + d.to_goal(v) - d.length();
    size += std::max(0, max_delay - slack + 1);
  }
  if (!CommonEnd::is_needed(d)) return size;
  Timestep longest = 0;
  for (const VertexId goal : d.goals().vertices()) {
    d.for_each_end(goal, [&](VertexId end) {
      if (d.from_start(end) == kUnreachable) return;
      const Timestep slack = d.from_start(end) + d.price(goal) - d.length();
      size += std::max(0, max_delay - slack + 1);
    });
    longest = std::max(longest, d.price(goal));
  }
  return size + std::int64_t{longest + 1} * (max_delay + 1);
}

const Graph& ExplicitPaths::graph(AgentId agent) const {
  const std::optional<CommonEnd>& common = agents_[agent].common;
  return common ? common->graph() : model_.distances(agent).states();
}

void ExplicitPaths::make_paths(AgentId agent) {
  Agent& a = agents_[agent];
  const AgentDistances& d = model_.distances(agent);
  VertexId end;
  if (CommonEnd::is_needed(d)) {
    end = a.common.emplace(d).home();
  } else {
    d.for_each_end(d.goals().only(), [&](VertexId state) { end = state; });
  }
  a.paths.emplace(graph(agent), discrete::Agent{d.start_state(), end});
  QUADRILLE_REQUIRE(a.paths->mdd().distance() == d.length() + (a.common ? kWayHome : 0),
                    "delays count from the same length");
}

void ExplicitPaths::on_path_lemma(AgentId agent, Timestep cap, FormulaWriter& writer) {
  Agent& a = agents_[agent];
  const AgentDistances& d = model_.distances(agent);
  if (++a.num_lemmas < std::max(price_.first_look, a.next_look) || cap == kForever) return;
  const Timestep delay = cap - d.length();
  const Timestep old_cap = a.paths ? a.paths->cap() : -1;
  if (delay <= old_cap) return;
  if (price_.lemmas * size(agent, delay) > price_.variables * a.num_lemmas) {
    a.next_look = 2 * a.num_lemmas;
    return;
  }
  if (!a.paths) make_paths(agent);
  AgentFormula formula(model_, agent, writer);
  if (!a.paths->extend(graph(agent), delay, formula, nullptr)) {
    a.next_look = INT64_MAX;
    return;
  }
  if (d.has_bans()) add_bans(agent, old_cap, writer);
  for (const ObstacleId id : a.obstacles) link(agent, id, old_cap, writer);
}

Lit ExplicitPaths::gone(AgentId agent, VertexId state, Timestep t, FormulaWriter& writer) {
  const AgentDistances& d = model_.distances(agent);
  if (agents_[agent].common || !d.leaves() || !d.is_goal(state) || t <= d.free_cost()) return {};
  return ~model_.cost_above(agent, t - 1, writer);
}

void ExplicitPaths::add_bans(AgentId agent, Timestep old_cap, FormulaWriter& writer) {
  const AgentDistances& d = model_.distances(agent);
  const MddPaths& paths = *agents_[agent].paths;
  const auto add = [&](std::initializer_list<Lit> lits) {
    std::vector<Lit> clause;
    for (const Lit lit : lits)
      if (lit.valid()) clause.push_back(lit);
    writer.add({sat::why::ExplicitPath{agent}, clause, {}, false});
  };
  for (Timestep slack = old_cap + 1; slack <= paths.cap(); ++slack)
    for (const VertexId v : IdRange<VertexId>(d.states().num_vertices())) {
      if (d.to_goal(v) == kUnreachable) continue;
      const Timestep t = d.time(v, slack);
      const Lit here = paths.at(v, t);
      if (!here.valid()) continue;
      if (d.is_banned(d.place(v), t)) add({~here, gone(agent, v, t, writer)});
      if (t == 0) continue;
      // Steps into the new layer come from it or from older ones.
      for (const VertexId u : d.states().predecessors(v))
        if (const Lit before = paths.at(u, t - 1);
            before.valid() && d.is_step_banned(d.place(u), d.place(v), t - 1))
          add({~before, ~here});
    }
  if (!agents_[agent].common) return;
  for (const CommonEnd::End& end : agents_[agent].common->ends())
    for (Timestep slack = old_cap + 1; slack <= paths.cap(); ++slack) {
      const Timestep t = paths.mdd().timestep(end.rest, slack);
      const Lit here = paths.at(end.rest, t);
      if (here.valid() && t - 1 < d.may_rest_from(end.goal)) add({~here});
    }
}

void ExplicitPaths::link_new_obstacles(FormulaWriter& writer) {
  for (; num_linked_ < model_.obstacles().size(); ++num_linked_) {
    const ObstacleId id(num_linked_);
    const AgentId agent = model_.obstacles()[id].agent;
    agents_[agent].obstacles.push_back(id);
    if (agents_[agent].paths) link(agent, id, -1, writer);
  }
}

// Of who leaves only where it ends counts.
void ExplicitPaths::link_rests(AgentId agent, const Obstacle& obstacle, Timestep old_cap,
                               FormulaWriter& writer) {
  const MddPaths& paths = *agents_[agent].paths;
  const bool is_about_ends =
      obstacle.kind == Obstacle::Kind::end || obstacle.kind == Obstacle::Kind::elsewhere;
  if (model_.distances(agent).leaves() && !is_about_ends) return;
  for (const CommonEnd::End& end : agents_[agent].common->ends()) {
    const Timestep last = model_.obstacles().last_block(obstacle, end.goal);
    for (Timestep slack = old_cap + 1; slack <= paths.cap(); ++slack) {
      const Timestep t = paths.mdd().timestep(end.rest, slack);
      if (t - 1 > last) break;
      const Lit here = paths.at(end.rest, t);
      if (!here.valid()) continue;
      const std::array clause{~here, obstacle.allowed};
      writer.add({sat::why::ExplicitPath{agent}, clause, {}, false});
    }
  }
}

void ExplicitPaths::link(AgentId agent, ObstacleId id, Timestep old_cap, FormulaWriter& writer) {
  const MddPaths& paths = *agents_[agent].paths;
  const AgentDistances& d = model_.distances(agent);
  const Obstacle o = model_.obstacles()[id];
  if (agents_[agent].common) link_rests(agent, o, old_cap, writer);
  const auto is_new = [&](VertexId v, Timestep t) { return paths.mdd().slack(v, t) > old_cap; };
  // Of a state.
  const auto visit = [&](VertexId v, Timestep t) {
    const Lit at = paths.at(v, t);
    if (!at.valid() || !is_new(v, t)) return;
    const std::array clause{~at, o.allowed, gone(agent, v, t, writer)};
    writer.add({sat::why::ExplicitPath{agent},
                std::span(clause).first(clause.back().valid() ? 3 : 2),
                {},
                false});
  };
  const auto move = [&](VertexId v, VertexId w) {
    const Lit from = paths.at(v, o.first), to = paths.at(w, o.first + 1);
    if (!from.valid() || !to.valid() || !(is_new(v, o.first) || is_new(w, o.first + 1))) return;
    const std::array clause{~from, ~to, o.allowed};
    writer.add({sat::why::ExplicitPath{agent}, clause, {}, false});
  };
  switch (o.kind) {
    case Obstacle::Kind::point:
      d.for_each_state(o.vertex, [&](VertexId state) { visit(state, o.first); });
      break;
    case Obstacle::Kind::edge:
      d.for_each_step(o.vertex, o.to, move);
      d.for_each_step(o.to, o.vertex, move);
      break;
    case Obstacle::Kind::range:
      d.for_each_state(o.vertex, [&](VertexId state) {
        if (d.to_goal(state) == kUnreachable) return;
        const Timestep end = d.time(state, paths.cap());
        for (Timestep t = o.first; t <= std::min(o.last, end); ++t) visit(state, t);
      });
      break;
    case Obstacle::Kind::barrier:
      for (const Visit& v : model_.obstacles().visits(o))
        d.for_each_state(v.vertex, [&](VertexId state) { visit(state, v.timestep); });
      break;
    case Obstacle::Kind::end:
    case Obstacle::Kind::elsewhere:  // of rests alone
      break;
  }
}

}  // namespace quadrille::discrete
