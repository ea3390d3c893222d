// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "quadrille/core/effort.hpp"
#include "quadrille/core/ids.hpp"

namespace quadrille::solve {

/// What a search begins with, beside others. As its domain sees fit it goes on with the rest, when
/// nothing else is left.
enum class Role {
  all,    ///< Plans and the lower bound: alone, or nobody else makes plans.
  bound,  ///< The lower bound; plans come from elsewhere.
  plans,  ///< Plans.
  cores,  ///< Cores of drawn costs, for the one that raises the bound.
};

/// What searches of the same instance tell each other. `Extra` is what the domain adds:
/// `extra.hear(other)` takes in what another one, who has not been heard yet, has told.
template <class Plan, class Extra>
struct Message {
  Cost lower = 0;                    ///< Proven.
  std::shared_ptr<const Plan> plan;  ///< The cheapest; null if there is none.
  Cost cost = 0;                     ///< What it costs.
  Extra extra;
  bool others_ended = false;  ///< Nobody else is at work.

  void hear(const Message& other) {
    lower = std::max(lower, other.lower);
    if (other.plan && (!plan || other.cost < cost)) {
      plan = other.plan;
      cost = other.cost;
    }
    extra.hear(other.extra);
  }
};

/// The others that a running search works with. This one has none.
template <class Message>
class Exchange {
 public:
  virtual ~Exchange() = default;
  [[nodiscard]] virtual bool has_others() const { return false; }
  [[nodiscard]] virtual std::size_t worker() const { return 0; }
  [[nodiscard]] virtual Role role() const { return Role::all; }
  /// Called now and then with the effort of the search so far. May wait. At the end of a
  /// round: `tell()` is told to the others, and what they told comes back.
  [[nodiscard]] virtual std::optional<Message> arrive(Effort /*effort*/,
                                                      const std::function<Message()>& /*tell*/) {
    return std::nullopt;
  }
};

}  // namespace quadrille::solve
