// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::sat {

/// Who has to be there for what was refuted to hold: finds the bystanders of raises.
///
/// A clause about an agent says nothing where that agent costs as much as it likes: most clauses
/// contain the literal "it costs more". Not so those of agents that are *unconditional*: what they
/// do at whatever cost may be in others' way, and so they count wherever a clause links them to one
/// that counts. docs/soundness/cost.md, section 12, proves that this is enough.
class Dependence {
 public:
  explicit Dependence(std::size_t num_agents)
      : is_unconditional_(num_agents, false), links_(num_agents), cores_of_(num_agents) {}

  /// Some clause about the agent does not let it off for a high cost.
  void set_unconditional(AgentId agent) { is_unconditional_[agent] = true; }
  [[nodiscard]] bool is_unconditional(AgentId agent) const { return is_unconditional_[agent]; }
  /// Some clause speaks of both. In either order, as often as one likes.
  void link(AgentId a, AgentId b);
  /// Where all of `agents` count, those of `others` do, too. Without agents: everywhere.
  void imply(const std::vector<AgentId>& agents, std::vector<AgentId> others);

  /// Names the bystanders of a raise: the fewest agents that count besides its own.
  void add_bystanders(Raise& raise) const;

 private:
  struct Implication {
    std::size_t num_agents;
    std::vector<AgentId> others;
  };

  IdVector<AgentId, bool> is_unconditional_;
  IdVector<AgentId, std::set<AgentId>> links_;
  std::vector<Implication> implications_;
  IdVector<AgentId, std::vector<std::size_t>> cores_of_;  // implications with the agent
  std::vector<AgentId> always_;
};

}  // namespace quadrille::sat

QUADRILLE_API_END
