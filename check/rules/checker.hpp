// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "read/instance.hpp"
#include "rules/frame.hpp"
#include "rules/ledger.hpp"
#include "rules/meanings.hpp"
#include "rules/rules.hpp"

namespace quadrille_check {

/// Checks a certificate about agents on a graph.
class Checker final : public CheckerFrame {
 public:
  explicit Checker(const Instance& instance);  ///< Which outlives it.

  [[nodiscard]] const Meanings& meanings() const { return meanings_; }
  [[nodiscard]] const Ledger& ledger() const { return ledger_; }

 private:
  void check_own(const Record& record) override;
  void require_meaning(Int lit) const override { static_cast<void>(meanings_.variable(lit)); }
  [[nodiscard]] bool holds(Int rule, std::span<const Int> parameters,
                           std::span<const Int> clause) override;
  [[nodiscard]] Int proved(Int clause) const override;
  void require_infeasible(std::span<const Int> values) const override;
  [[nodiscard]] Int plan_cost(const std::vector<Ints>& paths) const override;

  const Instance& instance_;
  Distances distances_;
  Meanings meanings_;
  Ledger ledger_;
  OneAgent one_agent_;
};

}  // namespace quadrille_check
