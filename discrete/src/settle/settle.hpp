// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete {

/// A plan of any cost in polynomial time, for whatever check_feasibility calls feasible: one agent
/// after the other is led to a vertex of its own, farthest from the root of its component first;
/// who is in its way makes room, or is exchanged with it. All the others move towards their
/// vertices at the same time, see Rush. The technique of Push and Swap (Luna and Bekris, "Push and
/// swap: fast cooperative path-finding with completeness guarantees", IJCAI 2011), with rotations,
/// and complete for the rules with rotations: docs/complete.md. One thread.
class Settling {
 public:
  enum class State {
    working,  ///< `advance` can go on.
    found,    ///< There is a plan.
    given_up  ///< The instance is infeasible, or one of the exceptions of docs/complete.md.
  };

  /// `instance` outlives the object.
  explicit Settling(const Instance& instance);
  ~Settling();
  Settling(const Settling&) = delete;
  Settling& operator=(const Settling&) = delete;

  /// Works on until `effort` more is spent, a limit is met or it is over. Memory is asked for.
  State advance(std::int64_t effort, LimitMonitor& limits);
  [[nodiscard]] State state() const noexcept;
  [[nodiscard]] std::int64_t effort() const noexcept;  ///< Spent so far.
  /// Trimmed. nullopt if a limit of memory is met. Requires State::found. O(size of the plan).
  [[nodiscard]] std::optional<Plan> plan(LimitMonitor& limits) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::discrete
