// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/lazy/recorder.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// Where agents collide by the recorded lemmas, see Attribution::sites. Agents that someone's rest
/// keeps off a goal are among them, although that takes no collision lemma.
[[nodiscard]] std::vector<CollisionSite> collision_sites(const Model& model,
                                                         const lazy::Recorder& recorder);

}  // namespace quadrille::continuous
