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

#include "read/records.hpp"
#include "timed/meeting.hpp"
#include "timed/road.hpp"

namespace quadrille_check {

/// Setting out along an edge at one of the ticks from `begin` to before `end`; or being at a vertex
/// at some moment between the two.
struct TimedBan {
  bool is_stay = false;
  int place = 0;
  Int begin = 0, end = 0;  // kNever: for ever
};

/// What a variable says of a plan.
struct TimedVariable {
  enum class Kind { none, does_not, costs_at_most };
  Kind kind = Kind::none;
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
  [[nodiscard]] const TimedVariable& variable(Int lit) const;
  [[nodiscard]] Int num_variables() const { return static_cast<Int>(variables_.size()) - 1; }
  /// The agent, and more than what it costs, by a literal "costs more than"; nullopt otherwise.
  [[nodiscard]] std::optional<std::pair<int, Int>> at_least(Int lit) const;
  [[nodiscard]] int agent(Int number) const;

 private:
  const Road& road_;
  std::vector<TimedVariable> variables_ = std::vector<TimedVariable>(1);
};

/// What single agents can do.
class TimedPaths {
 public:
  explicit TimedPaths(const Road& road);  ///< Which outlives it.
  /// When the agent can be at its goal for good at the earliest if it keeps all bans, and the
  /// release and the deadline; nullopt: not by `most`.
  [[nodiscard]] std::optional<Int> arrival(int agent, std::span<const TimedBan* const> bans,
                                           Int most);

 private:
  using Table = std::shared_ptr<const std::vector<Int>>;
  /// How long the agent is under way to its goal at least, by vertex.
  [[nodiscard]] Table distances(int agent);

  const Road& road_;
  std::map<std::tuple<int, std::size_t, int>, Table> known_;
};

/// All rules.
class TimedRules {
 public:
  TimedRules(const Road& road, const TimedMeanings& meanings);  ///< Which outlive it.
  [[nodiscard]] bool holds(Int rule, std::span<const Int> parameters, std::span<const Int> clause);
  /// Plans count that cost less than this. To be called once, before any rule is asked for.
  void count_below(Int cost, bool is_makespan);
  /// The clause says that an agent costs at least so much.
  void raise_free_cost(std::span<const Int> clause);
  [[nodiscard]] const std::vector<Int>& free_costs() const { return free_costs_; }
  [[nodiscard]] Int free_sum() const { return free_sum_; }

 private:
  [[nodiscard]] bool has_no_path(std::span<const Int> parameters, std::span<const Int> clause);
  [[nodiscard]] bool is_encounter(std::span<const Int> clause) const;
  [[nodiscard]] bool is_ceiling(std::span<const Int> clause) const;
  [[nodiscard]] bool do_all_meet(int i, const TimedBan& a, int j, const TimedBan& b) const;
  [[nodiscard]] bool is_kept_out(Int lit, Int variable);
  [[nodiscard]] bool is_kept_out_by_obstacles(Int variable);
  /// Whether all that breaks the ban, by agent i, meets this motion.
  [[nodiscard]] bool is_in_the_way(const Motion& other, int i, const TimedBan& ban) const;

  const Road& road_;
  const TimedMeanings& meanings_;
  TimedPaths paths_;
  std::vector<Int> free_costs_;
  Int free_sum_ = 0;
  std::optional<Int> below_;
  bool is_makespan_ = false;
  std::set<std::pair<Int, Int>> kept_out_;  // literals, or 0: by obstacles, and variables
};

}  // namespace quadrille_check
