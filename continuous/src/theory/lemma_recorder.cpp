// SPDX-License-Identifier: MIT
#include "theory/lemma_recorder.hpp"

#include <algorithm>

namespace quadrille::continuous {

using sat::Lit;

namespace {

/// When a move that begins during the ban is under way; of a stay, when it is.
TickInterval span_of(const Instance& instance, const Obstacle& obstacle) {
  TickInterval span = obstacle.cause.when;
  if (obstacle.cause.kind == Ban::Kind::start)
    span.end += instance.duration(instance.class_of(obstacle.agent), EdgeId(obstacle.cause.place));
  return span;
}

Place at_vertex(VertexId v) { return {Place::Kind::vertex, v, v}; }

Place on_edge(Place::Kind kind, const Edge& edge) {
  return {kind, std::min(edge.from, edge.to), std::max(edge.from, edge.to)};
}

}  // namespace

LemmaRecorder::LemmaRecorder(const Model& model, sat::ClauseObserver* next)
    : model_(model),
      next_(next),
      is_unconditional_(model.instance().num_agents(), false),
      must_be_in_time_(model.instance().num_agents(), false) {}

void LemmaRecorder::on_lemma(const sat::Lemma& lemma) {
  if (next_ != nullptr) next_->on_lemma(lemma);
  if (lemma.kind == sat::LemmaKind::collision) {
    const auto one = model_.variable(lemma.clause[0]), other = model_.variable(lemma.clause[1]);
    if (one.kind == Model::VariableKind::cost)
      pairs_.emplace_back(one.agent, other.agent);
    else
      collisions_.emplace_back(one.obstacle, other.obstacle);
  } else if (lemma.kind == sat::LemmaKind::path && !lemma.usages.empty()) {
    const AgentId agent = lemma.usages.front().agent;
    if (!has_cost_literal(agent, lemma.clause)) is_unconditional_[agent] = true;
  } else if (lemma.kind == sat::LemmaKind::order && lemma.clause.size() == 1) {
    must_be_in_time_[model_.variable(lemma.clause[0]).agent] = true;
  }
}

void LemmaRecorder::on_learned(std::span<const Lit> clause) {
  if (next_ != nullptr) next_->on_learned(clause);
}

void LemmaRecorder::on_core(std::span<const Lit> clause) {
  if (next_ != nullptr) next_->on_core(clause);
}

bool LemmaRecorder::wants_learned() const { return next_ != nullptr && next_->wants_learned(); }

bool LemmaRecorder::has_cost_literal(AgentId agent, std::span<const Lit> clause) const {
  return std::any_of(clause.begin(), clause.end(), [&](Lit lit) {
    const auto variable = model_.variable(lit);
    return variable.kind == Model::VariableKind::cost && variable.agent == agent;
  });
}

std::vector<CollisionSite> LemmaRecorder::sites() const {
  std::vector<CollisionSite> sites;
  for (const auto& [a, b] : collisions_) {
    const Obstacle& one = model_.obstacles()[a];
    const Obstacle& other = model_.obstacles()[b];
    sites.push_back(one.agent < other.agent ? site_of(one, other) : site_of(other, one));
  }
  for (const Obstacle& obstacle : model_.obstacles()) {
    const auto variable = model_.variable(obstacle.allowed);
    if (variable.kind != Model::VariableKind::cost) continue;
    const VertexId goal = model_.instance().agent(variable.agent).goal;
    sites.push_back({obstacle.agent,
                     variable.agent,
                     {Place::Kind::goal, goal, goal},
                     {},
                     std::max<Cost>(variable.cost - 1, 0),
                     CollisionSite::kForever,
                     1});
  }
  return merged(std::move(sites));
}

CollisionSite LemmaRecorder::site_of(const Obstacle& one, const Obstacle& other) const {
  CollisionSite site{one.agent, other.agent, {}, {}, 0, 0, 1};
  if (one.cause.kind == Ban::Kind::stay)
    site.place = at_vertex(VertexId(one.cause.place));
  else if (other.cause.kind == Ban::Kind::stay)
    site.place = at_vertex(VertexId(other.cause.place));
  else
    set_crossing(one, other, site);
  const TickInterval a = span_of(model_.instance(), one), b = span_of(model_.instance(), other);
  const bool do_overlap = a.overlaps(b);
  const Ticks begin = do_overlap ? std::max(a.begin, b.begin) : std::min(a.begin, b.begin);
  const Ticks end = do_overlap ? std::min(a.end, b.end) : std::max(a.end, b.end);
  site.begin = std::max<Cost>(as_cost(begin), 0);
  site.end = end >= kForever ? CollisionSite::kForever : std::max(as_cost(end), site.begin + 1);
  return site;
}

void LemmaRecorder::set_crossing(const Obstacle& one, const Obstacle& other,
                                 CollisionSite& site) const {
  const Roadmap& roadmap = model_.instance().roadmap();
  const Edge& e = roadmap.edge(EdgeId(one.cause.place));
  const Edge& f = roadmap.edge(EdgeId(other.cause.place));
  site.place = on_edge(Place::Kind::edge, e);
  const Place second = on_edge(Place::Kind::edge, f);
  if (site.place == second) return;
  if (e.to == f.to || e.to == f.from)
    site.place = at_vertex(e.to);
  else if (e.from == f.to || e.from == f.from)
    site.place = at_vertex(e.from);
  else {
    site.place.kind = Place::Kind::crossing;
    site.other = second;
  }
}

sat::Dependence LemmaRecorder::dependence(bool has_plan) const {
  sat::Dependence dependence(is_unconditional_.size());
  std::vector<AgentId> unconditional, in_time;
  for (const AgentId i : model_.instance().agent_ids()) {
    if (must_be_in_time_[i]) in_time.push_back(i);
    if (!is_unconditional_[i]) continue;
    dependence.set_unconditional(i);
    unconditional.push_back(i);
  }
  // Otherwise nobody knows whether they can all do what they have to.
  if (!has_plan) dependence.imply({}, unconditional);
  // It cannot be assumed that they cost more.
  dependence.imply({}, in_time);
  for (const auto& [a, b] : collisions_)
    dependence.link(model_.obstacles()[a].agent, model_.obstacles()[b].agent);
  for (const auto& [i, j] : pairs_) dependence.link(i, j);
  for (const Obstacle& obstacle : model_.obstacles())
    if (const auto variable = model_.variable(obstacle.allowed);
        variable.kind == Model::VariableKind::cost)
      dependence.link(obstacle.agent, variable.agent);
  return dependence;
}

}  // namespace quadrille::continuous
