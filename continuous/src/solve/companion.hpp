// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "solve/news.hpp"

namespace quadrille::continuous {

/// What a search begins with, beside others. In the end all do what the first one does, because
/// nothing else is left: with seeds of their own.
enum class Role {
  all,    ///< Alone: a better plan, then cores, covers and sums.
  bound,  ///< Cores, covers and sums at once.
  plans,  ///< A better plan, then cores of drawn costs.
  cores,  ///< Cores of drawn costs.
};

/// The others that a running search works with.
class Companion {
 public:
  virtual ~Companion() = default;
  [[nodiscard]] virtual std::size_t worker() const = 0;
  [[nodiscard]] virtual Role role() const = 0;
  /// Called now and then with the elementary steps of the search so far. May wait. At the end of a
  /// round: `tell()` is told to the others, and what they told comes back.
  [[nodiscard]] virtual std::optional<News> on_effort(std::int64_t effort,
                                                      const std::function<News()>& tell) = 0;
};

}  // namespace quadrille::continuous
