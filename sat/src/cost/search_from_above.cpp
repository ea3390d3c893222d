// SPDX-License-Identifier: MIT
#include "cost/search_from_above.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::sat {

void SearchFromAbove::rebase(const Relaxation& relaxation) {
  if (parts_ && relaxation.bound() < parts_->counter.base() + context_.settings.above_rebase)
    return;
  if (parts_) parts_->counter.retire();
  parts_ = std::make_unique<Parts>(context_, offline_, relaxation);
  relaxation.note_excess(parts_->counter.proof_number());
}

Outcome SearchFromAbove::advance(Slice slice) {
  QUADRILLE_REQUIRE(parts_ && slice.conflicts, "rebase comes first, and the slice has an end");
  const std::int64_t end = context_.limits.conflicts() + *slice.conflicts;
  if (const Outcome outcome = parts_->neighbourhoods.advance(slice); outcome != Outcome::working)
    return outcome;
  const auto best = context_.bounds.upper();
  if (best && *best - context_.bounds.lower() <= context_.settings.above_candidates_within &&
      *best <= parts_->counter.largest())
    return parts_->candidates.advance(slice);
  return parts_->sum_descent.advance(
      {std::max<std::int64_t>(0, end - context_.limits.conflicts())});
}

}  // namespace quadrille::sat
