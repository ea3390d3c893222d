// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "traffic/scene.hpp"

namespace quadrille::continuous {

/// The instance of the scene, in which each agent has one goal of its own only: near ones, such
/// that nobody who stays is in the way of another one who stays. For searches that have to know
/// where agents end: a plan of it is one of the instance. nullopt says nothing about the instance.
/// Throws LimitReached. O(agents * (V + E + goals * agents)) time.
[[nodiscard]] std::optional<Instance> with_chosen_ends(Scene& scene);

}  // namespace quadrille::continuous
