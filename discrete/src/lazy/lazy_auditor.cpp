// SPDX-License-Identifier: MIT
#include "lazy/lazy_auditor.hpp"

#include <algorithm>
#include <utility>

#include "lazy/common_end.hpp"

namespace quadrille::discrete {

using sat::Lit;
using VariableKind = LazyModel::VariableKind;
using Kind = Obstacle::Kind;

LazyAuditor::LazyAuditor(const LazyModel& model, bool derive, std::optional<Plan> known_plan)
    : ClauseAuditor(derive, known_plan.has_value()),
      model_(model),
      known_plan_(std::move(known_plan)) {}

bool LazyAuditor::forbids_visit(const Obstacle& o, VertexId v, Timestep t) const {
  switch (o.kind) {
    case Kind::point:
      return o.vertex == v && o.first == t;
    case Kind::range:
      return o.vertex == v && o.first <= t && t <= o.last;
    case Kind::barrier: {
      const auto visits = model_.obstacles().visits(o);
      return std::find(visits.begin(), visits.end(), Visit{v, t}) != visits.end();
    }
    case Kind::edge:
    case Kind::end:
    case Kind::elsewhere:
      return false;
  }
  return false;
}

bool LazyAuditor::forbids_move(const Obstacle& o, VertexId v, VertexId w, Timestep t) const {
  return o.kind == Kind::edge && o.first == t &&
         ((o.vertex == v && o.to == w) || (o.vertex == w && o.to == v));
}

// The literals have to say what the usages say.
std::string LazyAuditor::audit_usages(const sat::Lemma& lemma) const {
  for (const sat::Usage& usage : lemma.usages) {
    if (usage.resource >= model_.obstacles().size()) return "a lemma names an unknown usage";
    const ObstacleId id(static_cast<std::size_t>(usage.resource));
    const Obstacle& o = model_.obstacles()[id];
    if (o.agent != usage.agent) return "a lemma mistakes the agent of a usage";
    const auto var = model_.variable(o.allowed);
    if (var.kind == VariableKind::cost || var.kind == VariableKind::rest) {
      const Goals& goals = model_.instance().agents()[var.agent].goals;
      const VertexId goal = var.kind == VariableKind::rest ? var.goal : goals.vertices().front();
      const bool says_where = var.kind == VariableKind::rest || goals.is_single();
      const bool holds = o.kind == Kind::range && o.last == kForever && var.agent != o.agent &&
                         says_where && goal == o.vertex && rests_from(var, goal) <= o.first &&
                         !o.allowed.positive();
      if (!holds) return "nobody rests where a target usage says so";
    } else if (var.kind != VariableKind::usage || var.obstacle != id) {
      return "a usage has a foreign literal";
    }
  }
  return "";
}

std::string LazyAuditor::audit(const sat::Lemma& lemma) {
  if (const auto* path = std::get_if<sat::why::Path>(&lemma.why))
    return audit_path(lemma, path->agent);
  if (const auto* path = std::get_if<sat::why::ExplicitPath>(&lemma.why))
    return audit_explicit(lemma.clause, path->agent);
  if (lemma.is<sat::why::Order>()) return audit_order(lemma.clause);
  if (lemma.is<sat::why::Rest>()) return audit_rest(lemma.clause);
  if (const auto* taken = std::get_if<sat::why::Taken>(&lemma.why))
    return audit_taken(lemma, taken->goal);
  if (sat::is_collision(lemma.why)) return audit_collision(lemma);
  return "the lazy model has no such lemmas";
}

std::string LazyAuditor::audit_path(const sat::Lemma& lemma, AgentId agent) const {
  if (lemma.usages.empty() || lemma.clause.empty()) return "a path lemma has an agent";
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  const auto cost = model_.variable(lemma.clause[0]);
  if (cost.kind != VariableKind::cost || cost.agent != agent || lemma.clause[0].positive())
    return "a path lemma begins with a cost";
  Demand demand{{}, {}, LazyModel::cap(cost), 0};
  for (const sat::Usage& usage : lemma.usages) {
    demand.avoided.push_back(
        model_.obstacles()[ObstacleId(static_cast<std::size_t>(usage.resource))]);
    if (usage.agent != agent) return "a path lemma is about one agent";
    if (std::find(lemma.clause.begin() + 1, lemma.clause.end(), demand.avoided.back().allowed) ==
        lemma.clause.end())
      return "a path lemma lacks the literal of a usage";
  }
  return has_path(agent, demand) ? "some path does not satisfy a path lemma" : "";
}

// No path may do the opposite of everything that the clause says.
std::string LazyAuditor::audit_explicit(Clause clause, AgentId agent) const {
  Demand demand;
  std::vector<Visit> elsewhere;  // where the clause says that it is
  const auto avoid_range = [&](VertexId v, Timestep first, Timestep last) {
    demand.avoided.push_back({Kind::range, agent, {}, v, {}, first, last, 0, 0});
  };
  for (const Lit lit : clause) {
    const auto var = model_.variable(lit);
    if (var.kind == VariableKind::own) {
      if (var.agent != agent) return "a clause is about the explicit paths of two agents";
      const Visit visit = model_.visit(var);
      demand.horizon = std::max(demand.horizon, visit.timestep);
      (lit.positive() ? elsewhere : demand.visits).push_back(visit);
    } else if (lit.positive() || var.kind == VariableKind::auxiliary) {
      return "explicit paths are bound to what is false";
    } else if (var.kind == VariableKind::usage) {
      if (var.agent != agent) return "explicit paths are bound to the usages of another agent";
      demand.avoided.push_back(model_.obstacles()[var.obstacle]);
    } else if (var.kind == VariableKind::rest) {  // of another agent
      if (var.agent == agent) return "explicit paths are bound to the agent's own rest";
      avoid_range(var.goal, rests_from(var, var.goal), kForever);
    } else if (var.agent == agent) {
      demand.bound = std::min(demand.bound.value_or(kForever), LazyModel::cap(var));
    } else {  // the other agent rests at its goal
      const VertexId goal = model_.instance().agents()[var.agent].goal();
      avoid_range(goal, rests_from(var, goal), kForever);
    }
  }
  bool holds = false;
  if (CommonEnd::is_needed(model_.distances(agent))) {
    holds = !has_way_home(agent, demand, elsewhere);
  } else {
    for (const Visit& visit : elsewhere) avoid_range(visit.vertex, visit.timestep, visit.timestep);
    holds = !has_path(agent, demand);
  }
  return holds ? "" : "some path does not satisfy a clause about explicit paths";
}

/// As has_path, where visits are those of an explicit path to a common end.
bool LazyAuditor::has_way_home(AgentId agent, const Demand& demand,
                               std::span<const Visit> elsewhere) const {
  const AgentDistances& d = model_.distances(agent);
  const CommonEnd common(d);
  const auto try_end = [&](const CommonEnd::End& end, Timestep arrives) {
    Demand way{demand.avoided, {}, {}, 0};
    const auto is_behind = [&](const Visit& visit) { return visit.timestep > arrives; };
    const auto is_there = [&](const Visit& visit) {
      return visit.vertex == common.state_at(end, arrives, d.price(end.goal), visit.timestep);
    };
    for (const Visit& visit : demand.visits) {
      if (is_behind(visit) && !is_there(visit)) return false;
      if (!is_behind(visit)) way.visits.push_back(visit);
    }
    for (const Visit& visit : elsewhere) {
      if (is_behind(visit) && is_there(visit)) return false;
      if (is_behind(visit)) continue;
      way.avoided.push_back(
          {Kind::point, agent, {}, visit.vertex, {}, visit.timestep, visit.timestep, 0, 0});
    }
    return has_path_until(arrives, agent, way, end.goal, true);
  };
  // Who arrives later than that can do so wherever it is when the clause has no more to say.
  const Timestep late = demand.horizon + static_cast<Timestep>(d.graph().num_vertices());
  for (const CommonEnd::End& end : common.ends()) {
    const Timestep latest = std::min(demand.bound.value_or(kForever) - d.price(end.goal), late);
    for (Timestep arrives = 0; arrives <= latest; ++arrives)
      if (try_end(end, arrives)) return true;
  }
  return false;
}

/// From when on an agent rests there that costs no more than the variable says.
Timestep LazyAuditor::rests_from(const LazyModel::Variable& var, VertexId goal) const {
  return LazyModel::cap(var) - model_.price(goal);
}

bool LazyAuditor::has_path(AgentId agent, const Demand& demand) const {
  const Goals& goals = model_.instance().agents()[agent].goals;
  const auto all = goals.vertices();
  if (!demand.bound) return has_path_until(demand.horizon, agent, demand, {});
  return std::any_of(all.begin(), all.end(), [&](VertexId goal) {
    return has_path_until(*demand.bound - model_.price(goal), agent, demand, goal);
  });
}

/// Ends at the goal then, and not before if `from_then`, or anywhere.
bool LazyAuditor::has_path_until(Timestep end, AgentId agent, const Demand& demand,
                                 std::optional<VertexId> goal, bool from_then) const {
  if (end < 0) return false;
  const Graph& graph = model_.instance().graph();
  const Agent& task = model_.instance().agents()[agent];
  const auto visit_allowed = [&](VertexId v, Timestep t) {
    return std::none_of(demand.avoided.begin(), demand.avoided.end(),
                        [&](const Obstacle& o) { return forbids_visit(o, v, t); }) &&
           std::all_of(demand.visits.begin(), demand.visits.end(), [&](const Visit& visit) {
             return visit.timestep != t || visit.vertex == v;
           });
  };
  const auto move_allowed = [&](VertexId v, VertexId w, Timestep t) {
    return std::none_of(demand.avoided.begin(), demand.avoided.end(),
                        [&](const Obstacle& o) { return forbids_move(o, v, w, t); });
  };
  IdVector<VertexId, bool> here(graph.num_vertices(), false);
  here[task.start] = visit_allowed(task.start, 0);
  for (Timestep t = 0; t < end; ++t) {
    IdVector<VertexId, bool> next(graph.num_vertices(), false);
    for (const VertexId v : IdRange<VertexId>(graph.num_vertices())) {
      if (!here[v]) continue;
      const bool may_stay = !from_then || t + 1 < end || v != goal;
      if (may_stay && visit_allowed(v, t + 1)) next[v] = true;
      for (const VertexId w : graph.neighbours(v))
        if (visit_allowed(w, t + 1) && move_allowed(v, w, t)) next[w] = true;
    }
    here = std::move(next);
  }
  if (!goal) return std::find(here.begin(), here.end(), true) != here.end();
  return here[*goal] &&
         std::none_of(
             demand.avoided.begin(), demand.avoided.end(),
             [&](const Obstacle& o) { return model_.obstacles().last_block(o, *goal) >= end; }) &&
         std::all_of(demand.visits.begin(), demand.visits.end(), [&](const Visit& visit) {
           return visit.timestep < end || visit.vertex == *goal;
         });
}

std::string LazyAuditor::audit_collision(const sat::Lemma& lemma) const {
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  std::vector<Obstacle> usages;
  std::vector<Lit> expected;
  std::vector<AgentId> agents;
  for (const sat::Usage& usage : lemma.usages) {
    usages.push_back(model_.obstacles()[ObstacleId(static_cast<std::size_t>(usage.resource))]);
    expected.push_back(~usages.back().allowed);
    agents.push_back(usage.agent);
  }
  std::sort(agents.begin(), agents.end());
  agents.erase(std::unique(agents.begin(), agents.end()), agents.end());
  if (agents.size() != 2 || usages.size() > 4) return "a collision needs two agents";
  if (!std::equal(expected.begin(), expected.end(), lemma.clause.begin(), lemma.clause.end()))
    return "a collision lemma does not say what its usages say";
  if (usages.size() == 2 && usages[0].kind == usages[1].kind && usages[0].kind != Kind::barrier &&
      usages[0].vertex == usages[1].vertex && usages[0].first == usages[1].first &&
      usages[0].last == usages[1].last && usages[0].to == usages[1].to &&
      usages[0].kind != Kind::range)
    return "";  // the same place and time
  return can_use_all(agents[0], agents[1], usages) ? "some plan makes all usages of a collision"
                                                   : "";
}

bool LazyAuditor::can_use_all(AgentId a, AgentId b, std::span<const Obstacle> usages) const {
  const Graph& graph = model_.instance().graph();
  const std::size_t n = graph.num_vertices();
  Timestep horizon = 0;
  for (const Obstacle& o : usages) horizon = std::max(horizon, o.last + 1);
  const auto used = [&](AgentId agent, VertexId from, VertexId to, Timestep arrival) {
    unsigned mask = 0;
    for (std::size_t k = 0; k < usages.size(); ++k)
      if (usages[k].agent == agent &&
          (forbids_visit(usages[k], to, arrival) ||
           (arrival > 0 && forbids_move(usages[k], from, to, arrival - 1))))
        mask |= 1U << k;
    return mask;
  };
  const unsigned all = (1U << usages.size()) - 1;
  // By pair of vertices: the sets of usages made so far, as a set of masks.
  std::vector<std::uint16_t> here(n * n, 0), next;
  const Agent &task_a = model_.instance().agents()[a], &task_b = model_.instance().agents()[b];
  const unsigned at_start =
      used(a, task_a.start, task_a.start, 0) | used(b, task_b.start, task_b.start, 0);
  here[task_a.start.index() * n + task_b.start.index()] =
      static_cast<std::uint16_t>(1U << at_start);
  const auto with_wait = [&](VertexId v) {
    std::vector<VertexId> steps(graph.neighbours(v).begin(), graph.neighbours(v).end());
    steps.push_back(v);
    return steps;
  };
  for (Timestep t = 1; t <= horizon; ++t) {
    next.assign(n * n, 0);
    for (std::size_t pair = 0; pair < n * n; ++pair) {
      if (here[pair] == 0) continue;
      const VertexId u(pair / n), v(pair % n);
      for (const VertexId x : with_wait(u))
        for (const VertexId y : with_wait(v)) {
          if (x == y || (x == v && y == u)) continue;
          const unsigned now = used(a, u, x, t) | used(b, v, y, t);
          for (unsigned mask = 0; mask <= all; ++mask)
            if ((here[pair] >> mask & 1U) != 0)
              next[x.index() * n + y.index()] |= static_cast<std::uint16_t>(1U << (mask | now));
        }
    }
    here.swap(next);
    for (const std::uint16_t masks : here)
      if ((masks >> all & 1U) != 0) return true;
  }
  return false;
}

std::string LazyAuditor::audit_order(Clause clause) const {
  if (clause.size() != 2) return "an order lemma has two literals";
  const auto stronger = model_.variable(clause[0]), weaker = model_.variable(clause[1]);
  const bool holds = stronger.kind == VariableKind::cost && weaker.kind == VariableKind::cost &&
                     stronger.agent == weaker.agent && clause[0].positive() &&
                     !clause[1].positive() && stronger.cost > weaker.cost;
  return holds ? "" : "an order lemma does not hold";
}

// "It does not end there, or it costs that much, or it rests there and costs less."
std::string LazyAuditor::audit_rest(Clause clause) const {
  if (clause.size() != 3) return "a lemma about a rest has three literals";
  const auto end = model_.variable(clause[0]), cost = model_.variable(clause[1]);
  const auto rest = model_.variable(clause[2]);
  const bool holds = end.kind == VariableKind::usage && clause[0].positive() &&
                     model_.obstacles()[end.obstacle].kind == Kind::end &&
                     cost.kind == VariableKind::cost && !clause[1].positive() &&
                     rest.kind == VariableKind::rest && clause[2].positive() &&
                     end.agent == rest.agent && cost.agent == rest.agent &&
                     cost.cost == rest.cost && model_.obstacles()[end.obstacle].vertex == rest.goal;
  return holds ? "" : "a lemma about a rest does not hold";
}

// "Nobody ends there, or one of all those does who can": they do not end elsewhere.
std::string LazyAuditor::audit_taken(const sat::Lemma& lemma, VertexId goal) const {
  if (std::string wrong = audit_usages(lemma); !wrong.empty()) return wrong;
  const auto left_over = model_.variable(lemma.clause.front());
  if (left_over.kind != VariableKind::left_over || left_over.goal != goal ||
      !lemma.clause.front().positive())
    return "a lemma about a goal that is taken begins with that it is left over";
  for (const AgentId i : model_.instance().agent_ids()) {
    if (!model_.instance().agents()[i].goals.contains(goal)) continue;
    const bool is_named = std::any_of(lemma.clause.begin() + 1, lemma.clause.end(), [&](Lit lit) {
      const auto var = model_.variable(lit);
      if (var.kind != VariableKind::usage || var.agent != i || !lit.positive()) return false;
      const Obstacle& o = model_.obstacles()[var.obstacle];
      return o.kind == Kind::elsewhere && o.vertex == goal;
    });
    if (!is_named) return "somebody else can take the goal";
  }
  return "";
}

std::optional<bool> LazyAuditor::find_in_plan(Lit lit) const {
  const auto var = model_.variable(lit);
  if (var.kind == VariableKind::left_over) {
    const auto& paths = known_plan_->paths;
    return std::none_of(paths.begin(), paths.end(), [&](const Path& path) {
             return path.back() == var.goal;
           }) == lit.positive();
  }
  const Path& path = known_plan_->paths[var.agent];
  const Cost cost = arrival(path) + model_.price(path.back());
  switch (var.kind) {
    case VariableKind::usage:  // the negated variable: the agent does it
      return model_.obstacles().hits(var.obstacle, path,
                                     model_.instance().agents()[var.agent].leaves) !=
             lit.positive();
    case VariableKind::cost:  // the negated variable: the agent costs more
      return (cost >= var.cost) != lit.positive();
    case VariableKind::rest:
      return (path.back() == var.goal && cost < var.cost) == lit.positive();
    case VariableKind::own:
      return (explicit_state(var.agent, path, model_.visit(var).timestep) ==
              model_.visit(var).vertex) == lit.positive();
    case VariableKind::left_over:
    case VariableKind::auxiliary:
      break;
  }
  return std::nullopt;
}

/// Where the explicit path of an agent is that has this path.
VertexId LazyAuditor::explicit_state(AgentId agent, const Path& path, Timestep t) const {
  const AgentDistances& d = model_.distances(agent);
  const auto arrives = static_cast<Timestep>(arrival(path));
  if (t <= arrives || !CommonEnd::is_needed(d)) return d.state_at(path, t);
  const CommonEnd common(d);
  const VertexId last = d.state_at(path, arrives);
  const auto end = std::find_if(common.ends().begin(), common.ends().end(),
                                [&](const CommonEnd::End& e) { return e.state == last; });
  return common.state_at(*end, arrives, d.price(end->goal), t);
}

std::string LazyAuditor::describe(Clause clause) const {
  std::string text;
  for (const Lit lit : clause) {
    const auto var = model_.variable(lit);
    const std::string agent = std::to_string(var.agent.value());
    const bool is_negated = var.kind == VariableKind::usage || var.kind == VariableKind::cost;
    text += lit.positive() != is_negated ? " +" : " -";
    if (var.kind == VariableKind::own) {
      const Visit visit = model_.visit(var);
      const AgentDistances& d = model_.distances(var.agent);
      const bool is_home = visit.vertex.index() >= d.states().num_vertices();
      text += "at(" + agent + "," +
              (is_home ? "home " + std::to_string(visit.vertex.index())
                       : vertex_name(model_.instance().graph(), d.place(visit.vertex))) +
              "," + std::to_string(visit.timestep) + ")";
    } else if (var.kind == VariableKind::auxiliary) {
      text += "v" + std::to_string(lit.variable());
    } else if (var.kind == VariableKind::left_over) {
      text += "left over(" + vertex_name(model_.instance().graph(), var.goal) + ")";
    } else if (var.kind == VariableKind::rest) {
      text += "rest(" + agent + "," + vertex_name(model_.instance().graph(), var.goal) + ",<" +
              std::to_string(var.cost) + ")";
    } else if (var.kind == VariableKind::cost) {
      text += "cost(" + agent + ")>=" + std::to_string(var.cost);
    } else {
      const Obstacle& o = model_.obstacles()[var.obstacle];
      text += "use(" + agent + ",kind " + std::to_string(static_cast<int>(o.kind)) + "," +
              vertex_name(model_.instance().graph(), o.vertex) + "," + std::to_string(o.first) +
              ".." + std::to_string(o.last) + ")";
    }
  }
  return text;
}

}  // namespace quadrille::discrete
