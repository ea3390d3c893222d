// SPDX-License-Identifier: MIT
#pragma once

#include "lazy/lazy_model.hpp"
#include "quadrille/sat/certificate.hpp"

namespace quadrille::discrete {

/// What the lazy path model's literals and lemmas mean, for certificates (docs/certificates.md).
class LazyMeanings final : public sat::ProofMeanings {
 public:
  /// `model` outlives it.
  explicit LazyMeanings(const LazyModel& model) : model_(model) {}

  [[nodiscard]] bool declare(int variable, sat::CertificateWriter& writer) const override;
  [[nodiscard]] Rule rule_of(const sat::Why& why, std::span<const sat::Lit> clause) const override;
  [[nodiscard]] sat::Lit cost_above(AgentId agent, Cost cost) const override;

 private:
  void declare_usage(int variable, const Obstacle& obstacle, sat::CertificateWriter& writer) const;
  [[nodiscard]] std::int64_t place(VertexId v) const;

  const LazyModel& model_;
};

}  // namespace quadrille::discrete
