// SPDX-License-Identifier: MIT
#include "lazy/lemma_recorder.hpp"

#include <algorithm>
#include <optional>

namespace quadrille::discrete {

LemmaRecorder::LemmaRecorder(const LazyModel& model, sat::ClauseObserver* next)
    : model_(model), next_(next), is_explicit_(model.instance().num_agents(), false) {}

void LemmaRecorder::on_lemma(const sat::Lemma& lemma) {
  if (next_ != nullptr) next_->on_lemma(lemma);
  if (lemma.kind == sat::LemmaKind::collision) {
    for (const sat::Usage& usage : lemma.usages)
      usages_.emplace_back(static_cast<std::size_t>(usage.resource));
    ends_.push_back(usages_.size());
  } else if (lemma.kind == sat::LemmaKind::path && lemma.usages.empty()) {
    // Of explicit paths: each of their clauses has a literal of this kind.
    for (const sat::Lit lit : lemma.clause)
      if (const auto variable = model_.variable(lit); variable.kind == LazyModel::VariableKind::own)
        is_explicit_[variable.agent] = true;
  }
}

void LemmaRecorder::on_learned(std::span<const sat::Lit> clause) {
  if (next_ != nullptr) next_->on_learned(clause);
}

void LemmaRecorder::on_core(std::span<const sat::Lit> clause) {
  if (next_ != nullptr) next_->on_core(clause);
}

bool LemmaRecorder::wants_learned() const { return next_ != nullptr && next_->wants_learned(); }

template <class Visit>
void LemmaRecorder::for_each_lemma(const Visit& visit) const {
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    visit(Usages(usages_).subspan(begin, end - begin));
    begin = end;
  }
}

std::optional<AgentId> LemmaRecorder::resident_of(const Obstacle& obstacle) const {
  const auto variable = model_.variable(obstacle.allowed);
  if (variable.kind != LazyModel::VariableKind::cost) return std::nullopt;
  return variable.agent;
}

std::vector<CollisionSite> LemmaRecorder::sites() const {
  std::vector<CollisionSite> sites;
  for_each_lemma([&](Usages usages) {
    // One that names a single agent speaks of another one's start, too, but does not say whose.
    if (other_of(usages)) sites.push_back(site_of(usages));
  });
  for (std::size_t k = 0; k < model_.obstacles().size(); ++k) {
    const Obstacle& o = model_.obstacles()[ObstacleId(k)];
    if (const auto resident = resident_of(o))
      sites.push_back({o.agent,
                       *resident,
                       {Place::Kind::goal, o.vertex, o.vertex},
                       {},
                       o.first,
                       CollisionSite::kForever,
                       1});
  }
  return merged(std::move(sites));
}

std::optional<ObstacleId> LemmaRecorder::other_of(Usages usages) const {
  const ObstacleTable& table = model_.obstacles();
  for (const ObstacleId id : usages)
    if (table[id].agent != table[usages.front()].agent) return id;
  return std::nullopt;
}

CollisionSite LemmaRecorder::site_of(Usages usages) const {
  const ObstacleTable& table = model_.obstacles();
  const AgentId a = table[usages.front()].agent, b = table[*other_of(usages)].agent;
  CollisionSite site{std::min(a, b), std::max(a, b), {}, {}, 0, 0, 1};
  const Obstacle& one = table[usages.front()];
  if (one.kind == Obstacle::Kind::edge) {
    site.place = {Place::Kind::edge, one.vertex, one.to};
    site.begin = one.first;
    site.end = one.first + 2;  // a move takes from one timestep to the next
    return site;
  }
  // The earliest and the latest visit, in which a corridor or a rectangle begins and ends.
  std::optional<Visit> earliest, latest;
  bool has_barrier = false;
  const auto add = [&](VertexId vertex, Timestep from, Timestep to) {
    if (!earliest || from < earliest->timestep) earliest = {vertex, from};
    if (!latest || to > latest->timestep) latest = {vertex, to};
  };
  for (const ObstacleId id : usages) {
    const Obstacle& o = table[id];
    has_barrier = has_barrier || o.kind == Obstacle::Kind::barrier;
    if (o.kind == Obstacle::Kind::barrier)
      for (const Visit& visit : table.visits(o)) add(visit.vertex, visit.timestep, visit.timestep);
    else
      add(o.vertex, o.first, o.kind == Obstacle::Kind::range ? o.last : o.first);
  }
  const VertexId other_end = table[*other_of(usages)].vertex;
  if (has_barrier || usages.size() > 2)
    site.place = {Place::Kind::rectangle, earliest->vertex, latest->vertex};
  else if (one.vertex == other_end)
    site.place = {Place::Kind::vertex, one.vertex, one.vertex};
  else
    site.place = {Place::Kind::corridor, std::min(one.vertex, other_end),
                  std::max(one.vertex, other_end)};
  site.begin = earliest->timestep;
  site.end = latest->timestep == kForever ? CollisionSite::kForever : Cost{latest->timestep} + 1;
  return site;
}

sat::Dependence LemmaRecorder::dependence() const {
  const ObstacleTable& table = model_.obstacles();
  sat::Dependence dependence(is_explicit_.size());
  std::vector<AgentId> all;
  for (const AgentId i : IdRange<AgentId>(is_explicit_.size())) {
    all.push_back(i);
    if (is_explicit_[i]) dependence.set_unconditional(i);
  }
  for_each_lemma([&](Usages usages) {
    const AgentId a = table[usages.front()].agent;
    if (const auto other = other_of(usages))
      dependence.link(a, table[*other].agent);
    else
      dependence.imply({a}, all);  // who else it is about is not known
  });
  for (std::size_t k = 0; k < table.size(); ++k)
    if (const auto resident = resident_of(table[ObstacleId(k)]))
      dependence.link(table[ObstacleId(k)].agent, *resident);
  return dependence;
}

}  // namespace quadrille::discrete
