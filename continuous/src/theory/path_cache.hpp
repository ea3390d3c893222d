// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "theory/encounters.hpp"

namespace quadrille::continuous {

/// A path and what follows from it.
struct KnownPath {
  TimedPath path;
  PathUses uses;
  std::vector<Step> steps;
  std::uint64_t version = 0;                 ///< No two paths have the same.
  mutable std::optional<ObstacleId> breaks;  ///< An obstacle that it was found to run into last.
};
using KnownPathRef = std::shared_ptr<const KnownPath>;

/// The last different paths of one agent, the one that was used last first.
class PathCache {
 public:
  static constexpr std::size_t kCapacity = 16;

  /// The known path that equals `path`; otherwise it becomes one, with the next version.
  [[nodiscard]] KnownPathRef remember(const Instance& instance, AgentId agent, TimedPath path,
                                      std::uint64_t& last_version);
  /// A cheapest path, the one used last, of those that arrive by `cap` and of which `is_good` is
  /// true. Null: none.
  template <class Predicate>
  [[nodiscard]] KnownPathRef cheapest(Cost cap, const Predicate& is_good) const {
    KnownPathRef best;
    for (const KnownPathRef& known : paths_)
      if (as_cost(known->path.arrival) <= cap &&
          (!best || known->path.arrival < best->path.arrival) && is_good(known))
        best = known;
    return best;
  }

 private:
  std::vector<KnownPathRef> paths_;
};

}  // namespace quadrille::continuous
