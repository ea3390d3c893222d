// SPDX-License-Identifier: MIT
#pragma once

#include "bindings.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"
#include "quadrille/execution/precedences.hpp"
#include "timed.hpp"

namespace quadrille::python {

/// Of a plan of either domain. Raises InputError for one that is not valid.
execution::Precedences precedences_of(const discrete::Instance& instance,
                                      const discrete::Plan& plan);
execution::Precedences precedences_of(const TimedInstance& self, const continuous::Plan& plan);

}  // namespace quadrille::python
