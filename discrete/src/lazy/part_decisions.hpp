// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "quadrille/sat/lit.hpp"

namespace quadrille::discrete {

/// Chooses what to decide in part solves. As in VSIDS (Moskewicz et al. 2001, DAC), variables are
/// active that many recent clauses mention, but here only path lemmas count: they say which
/// obstacles cost agents something.
class PartDecisions {
 public:
  /// Each lemma counts 1.05 times as much as the one before. O(length of the clause), amortised.
  void on_path_lemma(std::span<const sat::Lit> clause);

  /// The literal with the most active variable; of several, the first. No literal if there are
  /// none.
  [[nodiscard]] sat::Lit choose(std::span<const sat::Lit> candidates) const;

 private:
  [[nodiscard]] double activity(sat::Lit lit) const;

  std::vector<double> activity_;  // by variable
  double weight_ = 1;             // of the next lemma
};

}  // namespace quadrille::discrete
