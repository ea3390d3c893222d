// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "certificate/certify.hpp"
#include "quadrille/continuous/solver.hpp"
#include "solve/desk.hpp"
#include "solve/warm_start.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// How often searches exchange what they know: a tenth of a second. Some parts of a search take
/// longer than a round, and others would wait for them. Measured on eight hard rows, mean wall
/// time: without lag 7 s, with 4 rounds 4.3 s, with 8 rounds 4.7 s, without any waiting 4.0 s; one
/// thread 5.2 s.
inline constexpr solve::Pace kUsualPace{Effort::microseconds(100'000), 4};

/// One search as by search_costs, or with options.threads several in threads of their own: the
/// first one with `scene` and `warm` raises the bound; the second one makes the plan cheaper, and
/// then finds cores for the first one, as further ones do: of costs that are drawn at random around
/// the last ones, which gives other cores than covers do, without waiting for these. They exchange
/// bounds, plans and cores; see solve::Portfolio. `account`: that of `desk.limits`. With
/// SolveOptions::proof they exchange no cores, and `proof` is that of the best bound.
void search_side_by_side(Scene& scene, const SolveOptions& options,
                         const std::shared_ptr<ResourceAccount>& account, const Desk& desk,
                         const solve::Pace& pace, const WarmStart& warm,
                         std::optional<ProofDraft>& proof);

}  // namespace quadrille::continuous
