// SPDX-License-Identifier: MIT
#include "lazy/part_decisions.hpp"

namespace quadrille::discrete {

using sat::Lit;

void PartDecisions::on_path_lemma(std::span<const Lit> clause) {
  constexpr double kGrowth = 1.05, kLimit = 1e100;
  for (const Lit lit : clause) {
    const auto index = static_cast<std::size_t>(lit.variable());
    if (activity_.size() <= index) activity_.resize(index + 1, 0.0);
    activity_[index] += weight_;
  }
  weight_ *= kGrowth;
  if (weight_ < kLimit) return;
  for (double& value : activity_) value /= kLimit;
  weight_ /= kLimit;
}

double PartDecisions::activity(Lit lit) const {
  const auto index = static_cast<std::size_t>(lit.variable());
  return index < activity_.size() ? activity_[index] : 0;
}

Lit PartDecisions::choose(std::span<const Lit> candidates) const {
  Lit best;
  for (const Lit lit : candidates)
    if (!best.valid() || activity(lit) > activity(best)) best = lit;
  return best;
}

}  // namespace quadrille::discrete
