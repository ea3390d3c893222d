// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "quadrille/core/ids.hpp"

namespace quadrille::discrete {

/// Where agents would like to go next, other than by the nearest way to their goals.
class Guidance {
 public:
  virtual ~Guidance() = default;
  /// From a vertex; nullopt: as the distances say.
  [[nodiscard]] virtual std::optional<VertexId> next(AgentId agent, VertexId from) const = 0;
};

}  // namespace quadrille::discrete
