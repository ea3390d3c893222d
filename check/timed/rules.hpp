// SPDX-License-Identifier: MIT
// When a clause is true in every plan in continuous time: docs/certificates.md, which proves the
// rules. Whether the answer "no" is right does not matter.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "rules/table.hpp"
#include "timed/pairs.hpp"

namespace quadrille_check {

/// What a variable says of a plan.
struct TimedVariable {
  enum class Kind { does_not, costs_at_most };
  Kind kind = Kind::does_not;
  int agent = 0;
  Int number = 0;              ///< Of a cost.
  std::vector<TimedBan> bans;  ///< does_not: do any of these.
};

/// The variables of a file.
class TimedMeanings {
 public:
  explicit TimedMeanings(const Road& road) : road_(road) {}  ///< Which outlives it.
  /// Records f and c. Throws Rejected.
  void add(const Record& record);
  /// Of the literal. Throws Rejected if it has no meaning.
  [[nodiscard]] const TimedVariable& variable(Int lit) const { return variables_[lit]; }
  /// The agent, and more than what it costs, by a literal "costs more than"; nullopt otherwise.
  [[nodiscard]] std::optional<std::pair<int, Int>> at_least(Int lit) const;
  [[nodiscard]] int agent(Int number) const;

 private:
  const Road& road_;
  VariableTable<TimedVariable> variables_;
};

/// All rules.
class TimedRules {
 public:
  TimedRules(const Road& road, const TimedMeanings& meanings);  ///< Which outlive it.
  /// Record m.
  void add_contact(const Record& record) { contacts_.add(record); }
  [[nodiscard]] bool holds(Int rule, std::span<const Int> parameters, std::span<const Int> clause);
  /// Plans count that cost less than this. To be called once, before any rule is asked for.
  void count_below(Int cost, bool is_makespan);
  /// The clause says that an agent costs at least so much.
  void raise_free_cost(std::span<const Int> clause);
  [[nodiscard]] const std::vector<Int>& free_costs() const { return free_costs_; }
  [[nodiscard]] Int free_sum() const { return free_sum_; }

 private:
  [[nodiscard]] bool has_no_path(std::span<const Int> parameters, std::span<const Int> clause);
  [[nodiscard]] bool is_pair(std::span<const Int> parameters, std::span<const Int> clause);
  struct Demand;
  /// What the negated literals say of the agent, and these variables.
  [[nodiscard]] std::optional<Demand> demand(Int agent, std::span<const Int> variables,
                                             std::span<const Int> clause);
  [[nodiscard]] bool is_encounter(std::span<const Int> clause) const;
  [[nodiscard]] bool is_ceiling(std::span<const Int> clause) const;
  [[nodiscard]] bool do_all_meet(int i, const TimedBan& a, int j, const TimedBan& b) const;
  [[nodiscard]] bool is_kept_out(Int lit, Int variable);
  [[nodiscard]] bool is_kept_out_by_obstacles(Int variable);

  const Road& road_;
  const TimedMeanings& meanings_;
  TimedPaths paths_;
  TimedContacts contacts_;
  std::vector<Int> free_costs_;
  Int free_sum_ = 0;
  std::optional<Int> below_;
  bool is_makespan_ = false;
  std::set<std::pair<Int, Int>> kept_out_;  // literals, or 0: by obstacles, and variables
};

}  // namespace quadrille_check
