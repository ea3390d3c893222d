// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "timed/bans.hpp"

namespace quadrille_check {

/// What single agents can do.
class TimedPaths {
 public:
  explicit TimedPaths(const Road& road);  ///< Which outlives it.
  /// When the agent can be at its goal for good at the earliest if it keeps all bans, and the
  /// release and the deadline; nullopt: not by `most`.
  [[nodiscard]] std::optional<Int> arrival(int agent, std::span<const TimedBan* const> bans,
                                           Int most);

  using Table = std::shared_ptr<const std::vector<Int>>;
  /// How long the agent is under way to its goal at least, by vertex.
  [[nodiscard]] Table distances(int agent);

 private:
  const Road& road_;
  std::map<std::tuple<int, std::size_t, int>, Table> known_;
};

}  // namespace quadrille_check
