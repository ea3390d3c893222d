// SPDX-License-Identifier: MIT
// The schedule of the core-guided search: who has a slice, and how long it is.
#include <algorithm>
#include <limits>
#include <optional>

#include "cost/core_extraction.hpp"
#include "cost/search_from_above.hpp"
#include "quadrille/sat/cost_search.hpp"

namespace quadrille::sat {
namespace {

/// Conflicts of the longest slices from below and from above, which grow.
constexpr std::int64_t kLongestSlice = 1 << 28;

SearchEnd end_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::found:
      return SearchEnd::found;
    case Outcome::exhausted:
      return SearchEnd::exhausted;
    default:
      return SearchEnd::stopped;
  }
}

}  // namespace

SearchEnd search_by_cores(CostSearchContext context, const CoreGuidedOptions& options,
                          Statistics& statistics) {
  // First, because a limit may end the search while the soft constraints are made.
  context.bounds.raise(context.problem.lower_bound());
  CoreExtraction cores(context, options, statistics);
  if (!cores.start()) return SearchEnd::stopped;
  if (!options.from_above) return end_of(cores.advance({}));

  std::optional<SearchFromAbove> above;
  const Settings& settings = context.settings;
  std::int64_t conflicts = settings.core_turn;
  while (true) {
    const std::int64_t from_below = above ? conflicts : settings.core_head_start * conflicts;
    Outcome outcome = cores.advance({from_below});
    if (outcome == Outcome::working) {
      if (!above) above.emplace(context);
      above->rebase(cores.relaxation());
      outcome = above->advance({settings.above_share * conflicts});
    }
    if (outcome != Outcome::working) {
      if (above) above->add_statistics(statistics);
      return end_of(outcome);
    }
    conflicts = std::max(conflicts, std::min(2 * conflicts, kLongestSlice));
  }
}

}  // namespace quadrille::sat
