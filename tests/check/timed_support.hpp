// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "check/support.hpp"
#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "timed/checker.hpp"

namespace quadrille_check::support {

/// The checker's own form of an instance, as it reads it from JSON.
[[nodiscard]] Road checked(const quadrille::continuous::Instance& instance);

/// Of records without a head, why they are rejected; empty if they are not.
[[nodiscard]] std::string rejection(const Road& road, const std::string& lines,
                                    bool is_makespan = false);
[[nodiscard]] inline bool accepts(const Road& road, const std::string& lines) {
  return rejection(road, lines).empty();
}
[[nodiscard]] Answer ask(const Road& road, const std::string& certificate);

/// What variables are in one plan.
class TimedInterpretation {
 public:
  TimedInterpretation(const TimedMeanings& meanings,
                      const quadrille::continuous::Instance& instance,
                      const quadrille::continuous::Plan& plan);
  [[nodiscard]] bool is_true(Int lit) const;
  [[nodiscard]] bool is_true(std::span<const Int> clause) const;

 private:
  struct Use {
    bool is_stay = false;
    std::vector<int> places;  // one of them: parallel edges
    Int begin = 0, end = 0;   // of a move: when it sets out
  };
  const TimedMeanings& meanings_;
  std::vector<std::vector<Use>> uses_;  // by agent
  std::vector<Int> costs_;
};

}  // namespace quadrille_check::support
