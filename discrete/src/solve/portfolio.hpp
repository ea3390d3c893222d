// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "certificate/certify.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/discrete/solver.hpp"
#include "solve/desk.hpp"
#include "solve/tuning.hpp"

namespace quadrille::discrete {

/// One search, or with options.threads several in threads of their own. The first one raises the
/// lower bound with `options`, the second one looks for plans and makes them cheaper, further ones
/// search with other systems (without options.first_plan the second one, too). They exchange
/// bounds, plans and drafts; see solve::Portfolio. `account`: that of `desk.limits`.
/// `proof`: of the one with the largest bound of its own.
void search_side_by_side(const Instance& instance, const SolveOptions& options, const Tuner& tuner,
                         const std::shared_ptr<ResourceAccount>& account, const Desk& desk,
                         ProofDraft& proof);

}  // namespace quadrille::discrete
