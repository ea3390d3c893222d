// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::execution::test {

/// Where bodies are while clocks run, in long double, with nothing of the library but the numbers
/// of instance and plan.
class Replay {
 public:
  using Real = long double;

  Replay(const continuous::Instance& instance, const continuous::Plan& plan)
      : instance_(instance), plan_(plan) {}

  /// The least separation of two agents whose clocks run from x0 to x1 and from y0 to y1 in the
  /// same time, evenly: negative where their interiors meet. Larger than 1 may be less than it is.
  [[nodiscard]] Real separation(AgentId i, Real x0, Real x1, AgentId j, Real y0, Real y1) const;
  /// Of all pairs.
  [[nodiscard]] Real least_separation(const std::vector<Real>& before,
                                      const std::vector<Real>& after) const;

 private:
  struct Vector {
    Real x = 0, y = 0, z = 0;
  };
  [[nodiscard]] Vector place(AgentId agent, Real clock) const;
  /// What it is then; exactly when a move begins, what it was before.
  [[nodiscard]] const geometry::Body& body(AgentId agent, Real clock) const;
  /// `offset`: of b from a.
  [[nodiscard]] static Real apart(const geometry::Body& a, const geometry::Body& b,
                                  const Vector& offset);
  /// With nothing but straight moves in between.
  [[nodiscard]] static Real straight(const geometry::Body& a, const geometry::Body& b,
                                     const Vector& from, const Vector& to);

  const continuous::Instance& instance_;
  const continuous::Plan& plan_;
};

/// Whether two agents collide in a step of the discrete domain, from the timesteps of the plan that
/// they have got to to those that they get to; both ends count.
[[nodiscard]] bool collide(const discrete::Instance& instance, const discrete::Plan& plan,
                           const std::vector<std::size_t>& before,
                           const std::vector<std::size_t>& after);

}  // namespace quadrille::execution::test
