// SPDX-License-Identifier: MIT
#include "theory/explanation.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

bool Explainer::has_path(const PathTask& task, BanTable& bans, Ticks bound) {
  return finder_.find(task, bans, bound, nullptr).has_value();
}

// Deletion, in chunks that become smaller, as most candidates are of no use.
void Explainer::explain(const PathTask& task, BanTable& bans, Ticks bound,
                        std::vector<std::size_t>& slots) {
  relevant_.assign(bans.num_slots(), 0);
  const auto arrival = finder_.find(task, bans, bound, nullptr, &relevant_);
  QUADRILLE_REQUIRE(!arrival.has_value(), "only what cannot be is explained");
  candidates_.clear();
  for (std::size_t slot = 0; slot < bans.num_slots(); ++slot) {
    bans.enable(slot, relevant_[slot] != 0);
    if (relevant_[slot] != 0) candidates_.push_back(slot);
  }
  for (std::size_t chunk = std::max<std::size_t>(candidates_.size() / 2, 1); !candidates_.empty();
       chunk /= 2) {
    for (std::size_t at = 0; at < candidates_.size();) {
      const auto begin = candidates_.begin() + static_cast<std::ptrdiff_t>(at);
      const auto end = candidates_.begin() +
                       static_cast<std::ptrdiff_t>(std::min(at + chunk, candidates_.size()));
      std::for_each(begin, end, [&](std::size_t slot) { bans.enable(slot, false); });
      if (has_path(task, bans, bound)) {
        std::for_each(begin, end, [&](std::size_t slot) { bans.enable(slot, true); });
        at += chunk;
      } else {
        candidates_.erase(begin, end);
      }
    }
    if (chunk == 1) break;
  }
  slots.insert(slots.end(), candidates_.begin(), candidates_.end());
  for (std::size_t slot = 0; slot < bans.num_slots(); ++slot) bans.enable(slot, true);
}

}  // namespace quadrille::continuous
