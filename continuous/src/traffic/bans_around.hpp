// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "traffic/steps.hpp"

namespace quadrille::continuous {

/// Bans that keep agents clear of what another one does. Those of a move or a stay are looked up
/// once, relative to its times, and kept.
class BansAround {
 public:
  /// `scene` outlives the object.
  explicit BansAround(Scene& scene) : scene_(scene) {}

  /// Appends bans for agents of class `a` that keep them clear of an agent of class `b` with these
  /// steps. Throws LimitReached.
  void add(ClassId a, ClassId b, const std::vector<Step>& steps, std::vector<Ban>& bans);

 private:
  using Known = std::unordered_map<std::uint64_t, std::vector<Ban>>;
  /// Of a move that starts at 0.
  [[nodiscard]] const std::vector<Ban>& of_move(ClassId a, ClassId b, EdgeId e);
  /// With the contact of each move instead of its starts, which depend on when the stay is.
  [[nodiscard]] const std::vector<Ban>& of_stay(ClassId a, ClassId b, VertexId v);
  [[nodiscard]] std::uint64_t key(ClassId a, ClassId b, std::uint32_t place) const;

  Scene& scene_;
  Known moves_, stays_;
};

}  // namespace quadrille::continuous
