// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lazy/lazy_model.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/lazy/recorder.hpp"

namespace quadrille::discrete {

/// Where agents collide by the recorded lemmas, see Attribution::sites. Agents that someone's rest
/// keeps off a goal are among them, although that takes no collision lemma.
[[nodiscard]] std::vector<CollisionSite> collision_sites(const LazyModel& model,
                                                         const lazy::Recorder& recorder);

}  // namespace quadrille::discrete
