// SPDX-License-Identifier: MIT
#include "lazy/lazy_theory.hpp"

namespace quadrille::discrete {

using sat::Lit;

const Plan& LazyTheory::draft() {
  if (draft_.paths.empty()) on_pause();
  return draft_;
}

Lit LazyTheory::decide(sat::TheoryContext& context) {
  if (!is_part_) return {};
  // After a lemma that the solver has not seen yet.
  if (trail_.any_violated([&](AgentId i) { return takes_part(i); })) return {};
  Separation separation = domain_.separation(trail_);
  std::vector<Encounter> collisions = separation.collisions();
  while (!collisions.empty() && (separation.bypass(collisions.front().first) ||
                                 separation.bypass(collisions.front().second)))
    collisions = separation.collisions();
  if (collisions.empty()) {
    context.stop();
    return {};
  }
  lazy::ContextWriter writer(context);
  for (const Encounter& e : collisions)
    if (const Lit usage = choose_usage(e, writer); usage.valid()) return ~usage;
  return {};
}

Lit LazyTheory::choose_usage(const Encounter& e, FormulaWriter& writer) {
  const auto usages = exclude(e, writer);
  notice_obstacles(writer);
  std::vector<Lit> open;
  for (const ObstacleId id : usages)
    if (const Lit allowed = domain_.obstacles()[id].allowed;
        trail_.value(allowed) == sat::Truth::unassigned)
      open.push_back(allowed);
  return domain_.decisions().choose(open);
}

}  // namespace quadrille::discrete
