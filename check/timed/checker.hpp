// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "rules/checker.hpp"
#include "timed/cover.hpp"

namespace quadrille_check {

/// Checks a certificate in continuous time record by record.
class TimedChecker {
 public:
  explicit TimedChecker(const Road& road);  ///< Which outlives it.

  /// Throws Rejected.
  void check(const Record& record);
  /// To be called after the last record. Throws Rejected.
  [[nodiscard]] Verdict verdict() const;

  [[nodiscard]] const TimedMeanings& meanings() const { return meanings_; }

 private:
  void check_head(const Record& record);
  void check_derived(const Record& record);
  void check_claim(const Record& record);
  [[nodiscard]] Int proved(Int clause) const;
  void add_path(const Record& record);

  const Road& road_;
  TimedMeanings meanings_;
  TimedRules rules_;
  Clauses clauses_;
  Cover cover_;
  std::optional<bool> is_makespan_;
  bool has_clauses_ = false;
  std::optional<Int> below_, claim_;
  bool is_infeasible_ = false;
  std::vector<std::optional<std::vector<Int>>> paths_;
};

/// What the plan costs: for each agent, each move's end, when it sets out and when it arrives.
/// Throws Rejected if it is none.
[[nodiscard]] Int cost_of(const Road& road, const std::vector<std::vector<Int>>& paths,
                          bool is_makespan);

}  // namespace quadrille_check
