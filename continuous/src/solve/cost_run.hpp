// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "certificate/certify.hpp"
#include "quadrille/continuous/solver.hpp"
#include "solve/desk.hpp"
#include "solve/warm_start.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// One search for the least cost with a model and an engine of its own, in the calling thread.
/// `scene` is complete and watches the limits of `desk`, where all that is found is left, whatever
/// ends it. Of `warm`, what was learned counts here. With SolveOptions::proof, `proof` is what the
/// bound rests on, unless memory ran out.
void search_costs(Scene& scene, const SolveOptions& options, const Desk& desk,
                  const WarmStart& warm, std::optional<ProofDraft>& proof);

}  // namespace quadrille::continuous
