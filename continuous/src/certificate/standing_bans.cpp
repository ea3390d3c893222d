// SPDX-License-Identifier: MIT
#include "certificate/standing_bans.hpp"

#include <cstdint>
#include <iterator>

namespace quadrille::continuous {
namespace {

using sat::CertificateWriter;
using sat::ProofMeanings;

/// Of a record `f`: bans follow.
constexpr int kBans = 4;

}  // namespace

void declare_bans(int variable, AgentId agent, std::span<const Ban> bans,
                  CertificateWriter& writer) {
  std::vector<std::int64_t> values{variable, ProofMeanings::agent_number(agent), kBans};
  for (const Ban& ban : bans) {
    values.push_back(ban.kind == Ban::Kind::stay ? 1 : 0);
    values.push_back(static_cast<std::int64_t>(ban.place));
    values.push_back(ban.when.begin.value());
    values.push_back(ban.when.end >= kForever ? -1 : ban.when.end.value());
  }
  writer.record('f', values);
}

// Checkers know by themselves that agents which are under way do not stop: where one of them
// begins, nobody else can be.
StandingBans::StandingBans(const Scene& scene, int num_variables)
    : scene_(scene), num_variables_(num_variables) {
  const Instance& instance = scene.instance();
  if (instance.obstacles().empty()) return;
  std::vector<bool> is_under_way(instance.roadmap().num_vertices(), false);
  for (const Agent& agent : instance.agents())
    if (agent.under_way) is_under_way[agent.start.index()] = true;
  for (const AgentId i : instance.agent_ids()) {
    std::vector<Ban> bans;
    for (const Ban& ban : scene.standing_bans(i)) {
      const bool is_of_move = ban.kind == Ban::Kind::start &&
                              is_under_way[instance.roadmap().edge(EdgeId(ban.place)).from.index()];
      if (!is_of_move && ban.when.end > 0) bans.push_back(ban);
    }
    if (!bans.empty()) bans_.emplace(i, std::move(bans));
  }
}

int StandingBans::variable(AgentId agent) const {
  const auto at = bans_.find(agent);
  if (at == bans_.end()) return 0;
  return num_variables_ + 1 + 2 * static_cast<int>(std::distance(bans_.begin(), at));
}

int StandingBans::last_variable() const {
  return num_variables_ + 2 * static_cast<int>(bans_.size());
}

void StandingBans::write(CertificateWriter& writer) const {
  for (const auto& [agent, bans] : bans_) {
    const int bans_variable = variable(agent), cost_variable = bans_variable + 1;
    declare_bans(bans_variable, agent, bans, writer);
    const Cost cost = scene_.free_cost(agent);
    // Where it has no way at all, a limit came before that was seen.
    if (cost == 0 || cost >= kAnyCost) continue;
    writer.negate(cost_variable);
    ProofMeanings::declare_cost(cost_variable, agent, cost - 1, writer);
    const sat::Lit clause[] = {sat::Lit::from_dimacs(cost_variable)};
    const std::int64_t parameters[] = {ProofMeanings::agent_number(agent), bans_variable};
    writer.record('b', {writer.axiom(kPathRule, parameters, clause)});
  }
}

}  // namespace quadrille::continuous
