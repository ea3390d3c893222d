// SPDX-License-Identifier: MIT
#include "certificate/mdd_meanings.hpp"

#include "certificate/records.hpp"

namespace quadrille::discrete {

using VariableKind = MddModel::VariableKind;
namespace why = sat::why;

bool MddMeanings::declare(int variable, sat::CertificateWriter& writer) const {
  const auto meaning = model_.variable(sat::Lit::from_dimacs(variable));
  switch (meaning.kind) {
    case VariableKind::auxiliary:
    case VariableKind::end:  // of agents with several goals, which certificates do not know
      return false;
    case VariableKind::vertex:
      writer.record('x', {variable, agent_number(meaning.agent),
                          place_number(model_.instance().graph(), meaning.vertex), meaning.number});
      return true;
    case VariableKind::delay:
      // Certificates have "costs at most".
      writer.negate(variable);
      declare_cost(variable, meaning.agent,
                   model_.mdd(meaning.agent).distance() + meaning.number - 1, writer);
      return true;
  }
  return false;
}

sat::ProofMeanings::Rule MddMeanings::rule_of(const sat::Why& reason,
                                              std::span<const sat::Lit> clause) const {
  if (const auto* path = std::get_if<why::Path>(&reason)) return one_agent_rule(path->agent);
  if (const auto* order = std::get_if<why::Order>(&reason)) return one_agent_rule(order->agent);
  if (std::holds_alternative<why::Vertex>(reason)) return {kSamePlaceRule, {}};
  if (std::holds_alternative<why::Edge>(reason)) return {kSwapRule, {}};
  if (std::holds_alternative<why::Goal>(reason))  // of who is there, not of who rests there
    for (const sat::Lit lit : clause)
      if (const auto meaning = model_.variable(lit); meaning.kind == VariableKind::vertex)
        return one_agent_rule(meaning.agent);
  return {};
}

sat::Lit MddMeanings::cost_above(AgentId agent, Cost cost) const {
  return model_.find_delay(agent, static_cast<Timestep>(cost + 1 - model_.mdd(agent).distance()));
}

}  // namespace quadrille::discrete
