// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "certificate/pair_contacts.hpp"
#include "certificate/standing_bans.hpp"
#include "quadrille/sat/certificate.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// What the literals and lemmas of continuous time mean, for certificates (docs/certificates.md).
class TimedMeanings final : public sat::ProofMeanings {
 public:
  /// `model` outlives it. `num_variables`: of the engine.
  TimedMeanings(Model& model, int num_variables);

  void begin(sat::CertificateWriter& writer) const override { standing_.write(writer); }
  [[nodiscard]] bool declare(int variable, sat::CertificateWriter& writer) const override;
  void prepare(const sat::Why& why, std::span<const sat::Lit> clause,
               sat::CertificateWriter& writer) const override;
  [[nodiscard]] Rule rule_of(const sat::Why& why, std::span<const sat::Lit> clause) const override;
  [[nodiscard]] sat::Lit cost_above(AgentId /*agent*/, Cost /*cost*/) const override { return {}; }

 private:
  static void declare(int variable, const Obstacle& obstacle, sat::CertificateWriter& writer) {
    declare_bans(variable, obstacle.agent, obstacle.bans, writer);
  }
  /// The obstacles that other agents at their goals are to this one, by the literals of a clause
  /// about its paths.
  [[nodiscard]] std::vector<ObstacleId> goals_around(AgentId agent,
                                                     std::span<const sat::Lit> clause) const;
  /// Of a clause about their paths: the agents, and which variables besides keep them out.
  [[nodiscard]] Rule rule_of_paths(int number, std::initializer_list<AgentId> agents,
                                   std::span<const sat::Lit> clause) const;
  void declare_goals(AgentId agent, std::span<const sat::Lit> clause,
                     sat::CertificateWriter& writer) const;

  /// What the agent costs at most if the clause is false; its deadline, or kAnyCost: nothing is
  /// said.
  [[nodiscard]] PairContacts::Party party(AgentId agent, std::span<const sat::Lit> clause) const;

  const Model& model_;
  const StandingBans standing_;
  mutable PairContacts contacts_;
  std::map<std::pair<AgentId, int>, ObstacleId> goals_;  // by agent and literal
  // Obstacles at goals have no variable in the solver.
  mutable std::map<ObstacleId, int> variables_;
  mutable int num_variables_;
};

}  // namespace quadrille::continuous
