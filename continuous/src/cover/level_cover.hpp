// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cover/cover_shares.hpp"
#include "cover/leaf_program.hpp"
#include "quadrille/core/effort.hpp"
#include "quadrille/core/grouping.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/limits.hpp"

namespace quadrille::continuous {

/// Of some agents: in all costs that hit these cores, they pay `bound` above their free costs.
struct ProvedCover {
  std::vector<LevelCore> cores;
  Cost bound = 0;
};

/// The hitting set problem of the cost search: costs of the agents, none below its free cost, such
/// that each core has an agent that reaches its level, and that the sum of the costs is least.
///
/// Agents that share no core, directly or not, are independent. For each group of agents a branch
/// and bound tree is kept from call to call: cores only shrink the set of solutions, so the bounds
/// of its leaves stay valid. Floating point (linear programs) guides the search and suggests
/// bounds; each bound is then computed from the suggestion in integers.
class LevelCover {
 public:
  explicit LevelCover(IdVector<AgentId, Cost> free_costs);

  /// Adds a core, unless one that is known implies it. Requires levels above the free costs.
  void add(LevelCore core);
  [[nodiscard]] std::size_t num_cores() const noexcept { return cores_.size(); }

  /// Of a call of solve at most, for each group of agents. A net: no call is known that takes as
  /// much.
  static constexpr Effort kMostEffort = Effort::microseconds(5'000'000);

  /// Finds costs of least sum, or some that hit all cores, as cheap as were found with
  /// `most_effort`; the next call goes on from there. False if `limits` ended that early: the
  /// costs are as before then.
  [[nodiscard]] bool solve(LimitMonitor& limits, Effort most_effort = kMostEffort);
  /// Of the last call of solve that returned true; at first the free costs.
  [[nodiscard]] const IdVector<AgentId, Cost>& costs() const noexcept { return costs_; }
  /// No costs that hit all cores of that call have a smaller sum; their own, if they are exact.
  [[nodiscard]] Cost total() const noexcept { return total_; }
  /// Whether the costs are of least sum.
  [[nodiscard]] bool is_exact() const noexcept { return is_exact_; }
  /// `costs`, raised and lowered until they hit all cores and none can be lowered alone. Requires
  /// costs of at least the free costs.
  [[nodiscard]] IdVector<AgentId, Cost> completed(IdVector<AgentId, Cost> costs) const;

  /// What the proven part of the total above the free costs is made of, core by core; cores that
  /// came after the last call of solve may have their shares, too. A linear program for each group
  /// of agents.
  [[nodiscard]] std::vector<CoverShare> shares() const;

  /// What the total is made of: for each group of agents of the last call of solve that returned
  /// true, the cores that it knew.
  [[nodiscard]] std::vector<ProvedCover> proved() const;

  [[nodiscard]] std::int64_t num_programs() const noexcept { return num_programs_; }
  /// Of all linear programs so far.
  [[nodiscard]] Effort effort() const noexcept {
    return program_.effort() * Effort::nanoseconds(5) / 4;
  }

 private:
  struct Group {
    std::vector<AgentId> agents;
    std::vector<const LevelCore*> cores;
    std::vector<std::uint32_t> numbers;  // of the cores, in the order in which they came
    CoreTable table;                     // of the cores
    std::vector<CoverSum> sums;          // that follow from the cores
    std::vector<CoverLeaf> open;         // a heap, the least bound first
    IdVector<AgentId, Cost> best;
    Cost cost = 0;  // what its agents pay above their free costs in `best`
    /// What they pay at least.
    [[nodiscard]] Cost bound() const {
      return open.empty() ? cost : std::min(cost, open.front().bound);
    }
  };

  [[nodiscard]] AgentId root(AgentId i) const;
  [[nodiscard]] std::vector<Group> make_groups() const;
  [[nodiscard]] bool solve(Group& group, LimitMonitor& limits, Effort most_effort);
  /// Solves the leaf's linear program. False: the leaf contains no solution.
  [[nodiscard]] bool relax(Group& group, CoverLeaf& leaf);
  [[nodiscard]] Cost price(const Group& group, const IdVector<AgentId, Cost>& costs) const;

  IdVector<AgentId, Cost> free_costs_;
  Grouping grouping_;  // of agents that ever shared a core
  struct KnownCore {
    LevelCore levels;
    std::uint32_t number = 0;
  };
  std::vector<KnownCore> cores_;
  std::uint32_t next_number_ = 0;
  std::vector<Group> groups_;  // of the last solve, for their trees
  struct Proved {
    CoreTable table;
    Cost bound = 0;
  };
  std::vector<Proved> proved_;  // by group, of the last solve that was complete
  IdVector<AgentId, Cost> costs_;
  Cost total_ = 0;
  bool is_exact_ = true;
  LeafProgram program_;
  std::int64_t num_programs_ = 0;
};

}  // namespace quadrille::continuous
