// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "read/records.hpp"
#include "rules/clauses.hpp"

namespace quadrille_check {

/// What a certificate proves.
struct Verdict {
  bool is_makespan = false;
  bool is_infeasible = false;  ///< There is no plan; what follows means nothing then.
  Int bound = 0;               ///< No plan costs less.
  std::optional<Int> cost;     ///< Of the plan in the file.
};

/// Checks a certificate record by record: what those on graphs and in continuous time have in
/// common, which is the head, how clauses follow, the claim, and that the plan costs no less.
class CheckerFrame {
 public:
  CheckerFrame(const CheckerFrame&) = delete;
  CheckerFrame& operator=(const CheckerFrame&) = delete;
  virtual ~CheckerFrame() = default;

  /// Throws Rejected.
  void check(const Record& record);
  /// To be called after the last record. Throws Rejected.
  [[nodiscard]] Verdict verdict() const;
  [[nodiscard]] const Clauses& clauses() const { return clauses_; }

 protected:
  explicit CheckerFrame(std::size_t num_agents) : paths_(num_agents) {}
  [[nodiscard]] bool is_makespan() const { return *is_makespan_; }

 private:
  // Throw Rejected.
  /// Any other record than those below.
  virtual void check_own(const Record& record) = 0;
  /// That the literal has a meaning.
  virtual void require_meaning(Int lit) const = 0;
  [[nodiscard]] virtual bool holds(Int rule, std::span<const Int> parameters,
                                   std::span<const Int> clause) = 0;
  /// What plans cost at least, by this clause; 0: without one.
  [[nodiscard]] virtual Int proved(Int clause) const = 0;
  /// That there is no plan.
  virtual void require_infeasible(std::span<const Int> values) const = 0;
  /// Of a plan: what follows the agent in its record, by agent.
  [[nodiscard]] virtual Int plan_cost(const std::vector<Ints>& paths) const = 0;

  void check_head(const Record& record);
  void check_axiom(const Record& record);
  void check_derived(const Record& record);
  void check_claim(const Record& record);
  void add_path(const Record& record);

 protected:
  Clauses clauses_;

 private:
  std::optional<bool> is_makespan_;
  std::optional<Int> claim_;
  bool is_infeasible_ = false;
  std::vector<std::optional<Ints>> paths_;
};

}  // namespace quadrille_check
