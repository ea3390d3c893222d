// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::cli {

/// A small plan for the eye: frames of a tiny grid, then one line of moves per agent. One line that
/// says why not for a plan too large to read. Requires a valid plan of the instance.
[[nodiscard]] std::string draw_plan(const discrete::Instance& instance, const discrete::Plan& plan);

}  // namespace quadrille::cli
