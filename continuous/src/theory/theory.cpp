// SPDX-License-Identifier: MIT
#include "theory/theory.hpp"

namespace quadrille::continuous {

void ContinuousTheory::check(sat::Extent extent, sat::TheoryContext& context) {
  using Mode = Question::Mode;
  if (question_.mode == Mode::never ||
      (question_.mode == Mode::complete && extent == sat::Extent::partial))
    return;
  PathTheory::check(extent, context);
}

bool ContinuousTheory::check_complete(std::span<const sat::Lit> assignment, FormulaWriter& target) {
  on_retract(0);
  on_assign(assignment);
  lazy::CheckWriter writer(target, nullptr);
  check_paths(writer);
  return !writer.has_excluded();
}

}  // namespace quadrille::continuous
