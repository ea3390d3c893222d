// SPDX-License-Identifier: MIT
#pragma once

#include "mdd/mdd_model.hpp"
#include "quadrille/sat/certificate.hpp"

namespace quadrille::discrete {

/// What the MDD model's literals and lemmas mean, for certificates (docs/certificates.md).
class MddMeanings final : public sat::ProofMeanings {
 public:
  /// `model` outlives it.
  explicit MddMeanings(const MddModel& model) : model_(model) {}

  [[nodiscard]] bool declare(int variable, sat::CertificateWriter& writer) const override;
  [[nodiscard]] Rule rule_of(const sat::Why& why, std::span<const sat::Lit> clause) const override;
  [[nodiscard]] sat::Lit cost_above(AgentId agent, Cost cost) const override;

 private:
  const MddModel& model_;
};

}  // namespace quadrille::discrete
