// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <vector>

#include "quadrille/sat/certificate.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// The rule that an agent has no path.
inline constexpr int kPathRule = 11;

/// What keeps agents clear of moving obstacles, and what they cost at least therefore, in a
/// certificate.
class StandingBans {
 public:
  /// Variables have numbers above `num_variables`.
  StandingBans(const Scene& scene, int num_variables);

  /// To be called once, before all clauses.
  void write(sat::CertificateWriter& writer) const;
  /// The variable "the agent does none of what moving obstacles forbid"; 0: these forbid it
  /// nothing.
  [[nodiscard]] int variable(AgentId agent) const;
  /// The highest number in use.
  [[nodiscard]] int last_variable() const;

 private:
  const Scene& scene_;
  const int num_variables_;
  std::map<AgentId, std::vector<Ban>> bans_;
};

/// Writes that the variable means: the agent does none of these.
void declare_bans(int variable, AgentId agent, std::span<const Ban> bans,
                  sat::CertificateWriter& writer);

}  // namespace quadrille::continuous
