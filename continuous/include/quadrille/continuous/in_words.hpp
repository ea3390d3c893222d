// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// How somebody speaks of what an instance has numbers and ticks for. All are callable.
struct Words {
  std::function<std::string(AgentId)> agent;         ///< With its quotes, if it has any.
  std::function<std::string(std::size_t)> obstacle;  ///< Likewise.
  std::function<std::string(VertexId)> vertex;
  std::function<std::string(Ticks)> time;  ///< With its unit, if it has one.
};

/// What Instance::make says of these parts, in the words of who gave them: agents, vertices and
/// moments are called what they are called there. `now`: as in Instance::make. `error`: the error
/// that it gave, which is the answer if there is nothing better to say.
[[nodiscard]] Error in_words(const Error& error, const std::shared_ptr<const Roadmap>& roadmap,
                             const std::vector<Agent>& agents, const Resolution& resolution,
                             const std::vector<MovingObstacle>& obstacles, Ticks now,
                             const Words& words);

}  // namespace quadrille::continuous

QUADRILLE_API_END
