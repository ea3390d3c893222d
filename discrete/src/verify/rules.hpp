// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "quadrille/discrete/verify.hpp"

namespace quadrille::discrete {

/// Number of vertices of a path for as long as its agent is there: what a path repeats at its end
/// is nothing to an agent that leaves. Requires a path that is not empty.
[[nodiscard]] std::size_t length_while_there(const Agent& agent, const Path& path);

/// What a path breaks of the rules of one agent: `tell(kind, t, message)` for each, `t` after the
/// beginning of the plan; the message has no subject. Requires a path that is not empty.
void check_own_rules(
    const Instance& instance, const Agent& agent, const Path& path,
    const std::function<void(Violation::Kind, Timestep, const std::string&)>& tell);

}  // namespace quadrille::discrete
