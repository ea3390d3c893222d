// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "quadrille/core/ids.hpp"

namespace quadrille::discrete {

/// A hash of the vertices of all agents at one timestep, the same on all platforms.
[[nodiscard]] inline std::uint64_t key_of(std::span<const VertexId> configuration) {
  std::uint64_t key = 0;
  for (const VertexId v : configuration) {
    key = (key ^ v.value()) * 0x9e3779b97f4a7c15ULL;
    key ^= key >> 29;
  }
  return key;
}

}  // namespace quadrille::discrete
