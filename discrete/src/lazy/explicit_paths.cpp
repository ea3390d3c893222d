// SPDX-License-Identifier: MIT
#include "lazy/explicit_paths.hpp"

#include <algorithm>
#include <array>

namespace quadrille::discrete {

using sat::Lit;

namespace {
/// Lemmas of an agent before its explicit paths are considered.
constexpr std::int64_t kFirstLook = 64;
}  // namespace

class ExplicitPaths::AgentFormula final : public MddPaths::Formula {
 public:
  AgentFormula(LazyModel& model, AgentId agent, FormulaWriter& writer)
      : model_(model), agent_(agent), writer_(writer) {}
  Lit new_vertex(VertexId v, Timestep t) override {
    return model_.new_vertex(agent_, {v, t}, writer_);
  }
  Lit delay_at_least(Timestep delay) override {
    const Timestep free_cost = model_.distances(agent_).free_cost();
    return model_.cost_above(agent_, free_cost + delay - 1, writer_);
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
  for (const VertexId v : IdRange<VertexId>(model_.instance().graph().num_vertices())) {
    if (d.from_start(v) == kUnreachable) continue;
    const Timestep slack = d.from_start(v) + d.to_goal(v) - d.free_cost();
    size += std::max(0, max_delay - slack + 1);
  }
  return size;
}

void ExplicitPaths::on_path_lemma(AgentId agent, Timestep cap, FormulaWriter& writer) {
  Agent& a = agents_[agent];
  // The clauses of MddPaths lead to one goal, without a price.
  const Goals& goals = model_.instance().agents()[agent].goals;
  if (!goals.is_single() || model_.price(goals.only()) > 0) return;
  if (++a.num_lemmas < std::max(kFirstLook, a.next_look) || cap == kForever) return;
  const Timestep delay = cap - model_.distances(agent).free_cost();
  const Timestep old_cap = a.paths ? a.paths->cap() : -1;
  if (delay <= old_cap) return;
  if (price_.lemmas * size(agent, delay) > price_.variables * a.num_lemmas) {
    a.next_look = 2 * a.num_lemmas;
    return;
  }
  const Graph& graph = model_.instance().graph();
  if (!a.paths) a.paths.emplace(graph, model_.instance().agents()[agent]);
  AgentFormula formula(model_, agent, writer);
  if (!a.paths->extend(graph, delay, formula, nullptr)) {
    a.next_look = INT64_MAX;
    return;
  }
  for (const ObstacleId id : a.obstacles) link(agent, id, old_cap, writer);
}

void ExplicitPaths::link_new_obstacles(FormulaWriter& writer) {
  for (; num_linked_ < model_.obstacles().size(); ++num_linked_) {
    const ObstacleId id(num_linked_);
    const AgentId agent = model_.obstacles()[id].agent;
    agents_[agent].obstacles.push_back(id);
    if (agents_[agent].paths) link(agent, id, -1, writer);
  }
}

void ExplicitPaths::link(AgentId agent, ObstacleId id, Timestep old_cap, FormulaWriter& writer) {
  const MddPaths& paths = *agents_[agent].paths;
  const Obstacle o = model_.obstacles()[id];
  const auto is_new = [&](VertexId v, Timestep t) { return paths.mdd().slack(v, t) > old_cap; };
  const auto visit = [&](VertexId v, Timestep t) {
    const Lit at = paths.at(v, t);
    if (!at.valid() || !is_new(v, t)) return;
    const std::array clause{~at, o.allowed};
    writer.add({sat::why::ExplicitPath{agent}, clause, {}, false});
  };
  const auto move = [&](VertexId v, VertexId w) {
    const Lit from = paths.at(v, o.first), to = paths.at(w, o.first + 1);
    if (!from.valid() || !to.valid() || !(is_new(v, o.first) || is_new(w, o.first + 1))) return;
    const std::array clause{~from, ~to, o.allowed};
    writer.add({sat::why::ExplicitPath{agent}, clause, {}, false});
  };
  switch (o.kind) {
    case Obstacle::Kind::point:
      visit(o.vertex, o.first);
      break;
    case Obstacle::Kind::edge:
      move(o.vertex, o.to);
      move(o.to, o.vertex);
      break;
    case Obstacle::Kind::range: {
      const AgentDistances& d = model_.distances(agent);
      const Timestep end = d.free_cost() + paths.cap() - d.to_goal(o.vertex);
      for (Timestep t = o.first; t <= std::min(o.last, end); ++t) visit(o.vertex, t);
      break;
    }
    case Obstacle::Kind::barrier:
      for (const Visit& v : model_.obstacles().visits(o)) visit(v.vertex, v.timestep);
      break;
    case Obstacle::Kind::end:  // path lemmas say what follows
      break;
  }
}

}  // namespace quadrille::discrete
