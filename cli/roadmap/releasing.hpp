// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::cli {

/// Called with one order per line, "\n" at its end. False: nobody reads them any more.
using TakeOrder = std::function<bool(const std::string&)>;

/// Orders of VDA 5050 as robots go: the first order of each, then, for each `state` message of a
/// robot (one line of JSON), an update for each robot that may go on. An update begins with the
/// last node that was released before, as VDA 5050 asks. Returns at the end of `states`, when all
/// have arrived, or when `take` says so. Errors (with `file` and line): what is no state message, a
/// robot that is not in the plan, a node that the robot had no release for. States of other orders
/// and older ones than known are passed over.
[[nodiscard]] std::optional<Error> release_orders(const continuous::Instance& instance,
                                                  const continuous::Plan& plan,
                                                  const execution::Precedences& order,
                                                  std::istream& states, const std::string& file,
                                                  const TakeOrder& take);

}  // namespace quadrille::cli
