// SPDX-License-Identifier: MIT
#include "theory/explanation.hpp"

#include <algorithm>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {

void Explainer::explain(const PathTask& task, BanTable& bans, Ticks bound,
                        std::vector<std::size_t>& slots) {
  for (std::size_t slot = 0; slot < bans.num_slots(); ++slot) bans.enable(slot, false);
  enough_.clear();
  while (finder_.find_any(task, bans, bound, &path_)) {
    const auto broken = first_broken(finder_.instance(), task.agent, path_, bans);
    QUADRILLE_REQUIRE(broken.has_value(), "only what cannot be is explained");
    bans.enable(*broken, true);
    enough_.push_back(*broken);
  }
  drop_unneeded(task, bans, bound);
  slots.insert(slots.end(), enough_.begin(), enough_.end());
  for (std::size_t slot = 0; slot < bans.num_slots(); ++slot) bans.enable(slot, true);
}

// The slot that was switched on last is needed whatever else goes: without it there was a path.
void Explainer::drop_unneeded(const PathTask& task, BanTable& bans, Ticks bound) {
  if (enough_.empty()) return;
  const std::size_t needed = enough_.back();
  std::sort(enough_.begin(), enough_.end());
  for (std::size_t at = enough_.size(); at-- > 0;) {
    const std::size_t slot = enough_[at];
    if (slot == needed) continue;
    bans.enable(slot, false);
    if (finder_.find_any(task, bans, bound, nullptr))
      bans.enable(slot, true);
    else
      enough_.erase(enough_.begin() + static_cast<std::ptrdiff_t>(at));
  }
}

}  // namespace quadrille::continuous
