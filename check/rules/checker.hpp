// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "read/instance.hpp"
#include "read/records.hpp"
#include "rules/clauses.hpp"
#include "rules/ledger.hpp"
#include "rules/meanings.hpp"
#include "rules/rules.hpp"

namespace quadrille_check {

/// What a certificate proves.
struct Verdict {
  bool is_makespan = false;
  bool is_infeasible = false;  ///< There is no plan; what follows means nothing then.
  Int bound = 0;               ///< No plan costs less.
  std::optional<Int> cost;     ///< Of the plan in the file.
};

/// Checks a certificate record by record.
class Checker {
 public:
  explicit Checker(const Instance& instance);  ///< Which outlives it.

  /// Throws Rejected.
  void check(const Record& record);
  /// To be called after the last record. Throws Rejected.
  [[nodiscard]] Verdict verdict() const;

  [[nodiscard]] const Clauses& clauses() const { return clauses_; }
  [[nodiscard]] const Meanings& meanings() const { return meanings_; }
  [[nodiscard]] const Ledger& ledger() const { return ledger_; }

 private:
  void check_head(const Record& record);
  void check_axiom(const Record& record);
  void check_derived(const Record& record);
  void check_claim(const Record& record);
  void add_path(const Record& record);
  [[nodiscard]] Int cost_of_plan() const;

  const Instance& instance_;
  Distances distances_;
  Meanings meanings_;
  Ledger ledger_;
  OneAgent one_agent_;
  Clauses clauses_;
  std::optional<bool> is_makespan_;
  std::optional<Int> claim_;
  bool is_infeasible_ = false;
  std::vector<std::vector<int>> paths_;
};

/// What the plan costs, whose paths end where their agents rest. Throws Rejected if it is none.
[[nodiscard]] Int cost_of(const Instance& instance, const std::vector<std::vector<int>>& paths,
                          bool is_makespan);

}  // namespace quadrille_check
