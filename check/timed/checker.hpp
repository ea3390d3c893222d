// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "rules/frame.hpp"
#include "timed/cover.hpp"

namespace quadrille_check {

/// Checks a certificate in continuous time.
class TimedChecker final : public CheckerFrame {
 public:
  explicit TimedChecker(const Road& road);  ///< Which outlives it.

  [[nodiscard]] const TimedMeanings& meanings() const { return meanings_; }

 private:
  void check_own(const Record& record) override;
  void require_meaning(Int lit) const override { static_cast<void>(meanings_.variable(lit)); }
  [[nodiscard]] bool holds(Int rule, std::span<const Int> parameters,
                           std::span<const Int> clause) override {
    return rules_.holds(rule, parameters, clause);
  }
  [[nodiscard]] Int proved(Int clause) const override;
  void require_infeasible(std::span<const Int> values) const override;
  [[nodiscard]] Int plan_cost(const std::vector<Ints>& paths) const override;

  const Road& road_;
  TimedMeanings meanings_;
  TimedRules rules_;
  Cover cover_;
  std::optional<Int> below_;
};

}  // namespace quadrille_check
