// SPDX-License-Identifier: MIT
#include "mdd/lemma_auditor.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mdd/usages.hpp"

namespace quadrille::discrete {

using sat::Lit;
using VariableKind = MddModel::VariableKind;

namespace {

/// What a path would have to do to make a path lemma false.
struct Escape {
  struct Visit {
    VertexId vertex;
    Timestep timestep;
    bool required;  // else forbidden
  };
  struct End {
    VertexId goal;
    bool required;  // else forbidden
  };
  std::vector<Visit> visits;
  std::vector<End> ends;
  Timestep latest_arrival = std::numeric_limits<Timestep>::max();

  [[nodiscard]] bool may_end_at(VertexId goal) const {
    return std::all_of(ends.begin(), ends.end(),
                       [&](const End& end) { return (end.goal == goal) == end.required; });
  }

  [[nodiscard]] bool allows(VertexId v, Timestep t) const {
    return std::all_of(visits.begin(), visits.end(), [&](const Visit& visit) {
      return visit.timestep != t || (visit.vertex == v) == visit.required;
    });
  }
};

/// True if a path does all that and ends at `goal`. O((V + E) * horizon * visits): only for
/// debugging.
bool can_escape(const Graph& graph, VertexId start, VertexId goal, const Escape& escape) {
  Timestep horizon = 0;
  for (const auto& visit : escape.visits) horizon = std::max(horizon, visit.timestep);
  const bool bounded = escape.latest_arrival != std::numeric_limits<Timestep>::max();
  if (bounded) horizon = std::max(horizon, escape.latest_arrival);
  IdVector<VertexId, bool> here(graph.num_vertices(), false);
  here[start] = escape.allows(start, 0);
  for (Timestep t = 1; t <= horizon; ++t) {
    IdVector<VertexId, bool> next(graph.num_vertices(), false);
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      if (!here[v]) continue;
      next[v] = next[v] || escape.allows(v, t);
      for (const VertexId w : graph.neighbours(v)) next[w] = next[w] || escape.allows(w, t);
    }
    if (bounded && t >= escape.latest_arrival)  // at rest by now
      for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
        next[v] = next[v] && v == goal;
    here = std::move(next);
  }
  if (bounded) return here[goal] && escape.latest_arrival >= 0;
  const auto to_goal = distances_from(graph, goal);
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    if (here[v] && to_goal[v] != kUnreachable) return true;
  return false;
}

}  // namespace

LemmaAuditor::LemmaAuditor(const MddModel& model, bool derive, std::optional<Plan> known_plan)
    : ClauseAuditor(derive, known_plan.has_value()),
      model_(model),
      known_plan_(std::move(known_plan)) {}

std::string LemmaAuditor::audit(const sat::Lemma& lemma) {
  if (const auto* path = std::get_if<sat::why::Path>(&lemma.why))
    return audit_path(lemma.clause, path->agent);
  if (lemma.is<sat::why::Order>()) return audit_order(lemma.clause);
  if (lemma.is<sat::why::Vertex>() || lemma.is<sat::why::Edge>() || lemma.is<sat::why::Goal>())
    return audit_collision(lemma);
  return "decision diagrams have no such lemmas";
}

std::string LemmaAuditor::audit_path(Clause clause, AgentId agent) const {
  Escape escape;
  for (const Lit lit : clause) {
    const auto var = model_.variable(lit);
    if (var.kind == VariableKind::auxiliary) return "a path lemma has a foreign literal";
    if (var.agent != agent) return "a path lemma is about one agent";
    if (var.kind == VariableKind::vertex) {
      escape.visits.push_back({var.vertex, var.number, !lit.positive()});
    } else if (var.kind == VariableKind::end) {
      escape.ends.push_back({var.vertex, !lit.positive()});
    } else if (lit.positive()) {
      const Timestep late = model_.mdd(agent).distance() + var.number;
      escape.latest_arrival = std::min(escape.latest_arrival, late - 1);
    } else {
      return "a path lemma needs no lower bound";
    }
  }
  const auto& instance = model_.instance();
  const Agent& task = instance.agents()[agent];
  for (const VertexId goal : task.goals.vertices())
    if (escape.may_end_at(goal) && can_escape(instance.graph(), task.start, goal, escape))
      return "some path does not satisfy a path lemma";
  return "";
}

std::string LemmaAuditor::audit_order(Clause clause) const {
  if (clause.size() != 2) return "an order lemma has two literals";
  const auto stronger = model_.variable(clause[0]), weaker = model_.variable(clause[1]);
  const bool holds = stronger.kind == VariableKind::delay && weaker.kind == VariableKind::delay &&
                     stronger.agent == weaker.agent && !clause[0].positive() &&
                     clause[1].positive() && stronger.number > weaker.number;
  return holds ? "" : "an order lemma does not hold";
}

std::string LemmaAuditor::audit_collision(const sat::Lemma& lemma) const {
  if (lemma.usages.size() != 2 || lemma.usages[0].agent == lemma.usages[1].agent)
    return "a collision needs two agents";
  // The literals that the two usages amount to.
  std::vector<Lit> expected;
  DecodedUsage use[2];
  for (int side = 0; side < 2; ++side) {
    const AgentId agent = lemma.usages[static_cast<std::size_t>(side)].agent;
    use[side] = decode_usage(lemma.usages[static_cast<std::size_t>(side)].resource);
    const DecodedUsage& u = use[side];
    if (u.kind == UsageKind::vertex || u.kind == UsageKind::move)
      expected.push_back(~model_.at(agent, u.vertex, u.timestep));
    if (u.kind == UsageKind::move) expected.push_back(~model_.at(agent, u.to, u.timestep + 1));
    if (u.kind == UsageKind::rest || u.kind == UsageKind::end) {
      if (!model_.may_stay(agent, u.vertex)) return "agents rest at their goals";
      if (const Lit ends = model_.end_at(agent, u.vertex); ends.valid()) expected.push_back(~ends);
    }
    if (u.kind == UsageKind::rest) expected.push_back(model_.arrival_after(agent, u.timestep));
  }
  const bool same_place = use[0].vertex == use[1].vertex && use[0].timestep == use[1].timestep &&
                          (use[0].kind == UsageKind::vertex || use[0].kind == UsageKind::rest) &&
                          use[1].kind == UsageKind::vertex;
  const bool same_end = use[0].kind == UsageKind::end && use[1].kind == UsageKind::end &&
                        use[0].vertex == use[1].vertex;
  const bool crossing = use[0].kind == UsageKind::move && use[1].kind == UsageKind::move &&
                        use[0].timestep == use[1].timestep && use[0].vertex == use[1].to &&
                        use[0].to == use[1].vertex &&
                        model_.instance().graph().adjacent(use[0].vertex, use[0].to);
  if (!same_place && !same_end && !crossing)
    return "the usages of a collision lemma do not collide";
  std::vector<Lit> clause(lemma.clause.begin(), lemma.clause.end());
  std::sort(clause.begin(), clause.end());
  std::sort(expected.begin(), expected.end());
  return clause == expected ? "" : "a collision lemma does not say what its usages say";
}

std::optional<bool> LemmaAuditor::find_in_plan(Lit lit) const {
  const auto var = model_.variable(lit);
  const Path& path = known_plan_->paths[var.agent];
  if (var.kind == VariableKind::auxiliary) return std::nullopt;
  const bool value = var.kind == VariableKind::vertex ? position(path, var.number) == var.vertex
                     : var.kind == VariableKind::end
                         ? path.back() == var.vertex
                         : arrival(path) >= model_.mdd(var.agent).distance() + var.number;
  return value == lit.positive();
}

std::string LemmaAuditor::describe(Clause clause) const {
  std::string text;
  for (const Lit lit : clause) {
    const auto var = model_.variable(lit);
    text += lit.positive() ? " +" : " -";
    const std::string number = std::to_string(var.number);
    const std::string agent = std::to_string(var.agent.value());
    if (var.kind == VariableKind::vertex)
      text += "X(" + agent + "," + vertex_name(model_.instance().graph(), var.vertex) + "," +
              number + ")";
    else if (var.kind == VariableKind::end)
      text += "E(" + agent + "," + vertex_name(model_.instance().graph(), var.vertex) + ")";
    else if (var.kind == VariableKind::delay)
      text += "C(" + agent + "," + number + ")";
    else
      text += "v" + std::to_string(lit.variable());
  }
  return text;
}

}  // namespace quadrille::discrete
