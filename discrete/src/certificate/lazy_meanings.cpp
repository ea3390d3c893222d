// SPDX-License-Identifier: MIT
#include "certificate/lazy_meanings.hpp"

#include <algorithm>
#include <vector>

#include "certificate/records.hpp"

namespace quadrille::discrete {

using sat::CertificateWriter;
namespace why = sat::why;

std::int64_t LazyMeanings::place(VertexId v) const {
  return place_number(model_.instance().graph(), v);
}

// Costs and usages are negated variables: a variable says "at most" and "does not".
bool LazyMeanings::declare(int variable, CertificateWriter& writer) const {
  using Kind = LazyModel::VariableKind;
  const auto meaning = model_.variable(sat::Lit::from_dimacs(variable));
  switch (meaning.kind) {
    case Kind::auxiliary:
    case Kind::rest:  // of agents with several goals, as ends: certificates know of neither
    case Kind::left_over:
      return false;
    case Kind::usage:
      declare_usage(variable, model_.obstacles()[meaning.obstacle], writer);
      return true;
    case Kind::cost:
      declare_cost(variable, meaning.agent, LazyModel::cap(meaning), writer);
      return true;
    case Kind::own: {
      const Visit visit = model_.visit(meaning);
      writer.record('x',
                    {variable, agent_number(meaning.agent), place(visit.vertex), visit.timestep});
      return true;
    }
  }
  return false;
}

void LazyMeanings::declare_usage(int variable, const Obstacle& o, CertificateWriter& writer) const {
  const std::int64_t agent = agent_number(o.agent);
  switch (o.kind) {
    case Obstacle::Kind::point:
      return writer.record('f', {variable, agent, 0, place(o.vertex), o.first});
    case Obstacle::Kind::edge:
      return writer.record('f', {variable, agent, 1, place(o.vertex), place(o.to), o.first});
    case Obstacle::Kind::range:
      return writer.record(
          'f', {variable, agent, 2, place(o.vertex), o.first, o.last == kForever ? -1 : o.last});
    case Obstacle::Kind::barrier: {
      std::vector<std::int64_t> values{variable, agent, 3};
      for (const Visit& visit : model_.obstacles().visits(o)) {
        values.push_back(place(visit.vertex));
        values.push_back(visit.timestep);
      }
      return writer.record('f', values);
    }
    case Obstacle::Kind::end:
    case Obstacle::Kind::elsewhere:
      return;
  }
}

sat::ProofMeanings::Rule LazyMeanings::rule_of(const sat::Why& reason,
                                               std::span<const sat::Lit>) const {
  if (const auto* path = std::get_if<why::Path>(&reason)) return one_agent_rule(path->agent);
  if (const auto* path = std::get_if<why::ExplicitPath>(&reason))
    return one_agent_rule(path->agent);
  if (const auto* order = std::get_if<why::Order>(&reason)) return one_agent_rule(order->agent);
  if (std::holds_alternative<why::Vertex>(reason) || std::holds_alternative<why::Edge>(reason))
    return {kSamePlaceRule, {}};
  if (const auto* r = std::get_if<why::Rectangle>(&reason))
    return {kRectangleRule,
            {r->from_x, r->from_y, r->to_x, r->to_y, r->begin, agent_number(r->horizontal),
             agent_number(r->vertical)}};
  if (const auto* corridor = std::get_if<why::Corridor>(&reason))
    return {kCorridorRule, {place(corridor->inside)}};
  return {};
}

sat::Lit LazyMeanings::cost_above(AgentId agent, Cost cost) const {
  const auto& rungs = model_.rungs(agent);
  const auto at = std::lower_bound(rungs.begin(), rungs.end(), cost + 1,
                                   [](const auto& rung, Cost c) { return rung.cost < c; });
  return at != rungs.end() && at->cost == cost + 1 ? at->at_least : sat::Lit();
}

}  // namespace quadrille::discrete
