// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "options.hpp"
#include "quadrille/continuous/solver.hpp"
#include "timed.hpp"

namespace quadrille::python {

/// Takes what the arguments say of a search on a roadmap.
continuous::SolveOptions options_of(const continuous::Resolution& resolution, Arguments& arguments,
                                    const std::atomic<bool>& interrupt);

/// An outcome without a search, once the arguments are those that a search takes. Requires
/// `no_plan`.
py::dict solve_refused(const TimedInstance& self, const py::dict& given);

}  // namespace quadrille::python
