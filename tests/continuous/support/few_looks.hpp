// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "quadrille/core/limits.hpp"
#include "traffic/scene.hpp"

namespace quadrille::continuous::test {

/// Calls look(scene, limits) with limits that are met at the first look at them, at that after the
/// next `step` ones and so on, below `most`; not where the scene itself is cut.
template <class Look>
void at_each_look(const Instance& instance, std::int64_t most, std::int64_t step,
                  const Look& look) {
  for (std::int64_t looks = 1; looks < most; looks += step) {
    Limits few;
    few.looks = looks;
    LimitMonitor limits(few);
    std::optional<Scene> scene;
    try {
      scene.emplace(instance, limits);
    } catch (const LimitReached&) {
      continue;
    }
    if (scene->is_complete()) look(*scene, limits);
  }
}

}  // namespace quadrille::continuous::test
