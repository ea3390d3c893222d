// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/execution/precedences.hpp"
#include "quadrille/exports/orders.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// Called with one order per line, "\n" at its end. False: nobody reads them any more.
using TakeOrder = std::function<bool(const std::string&)>;
/// Called with what the release goes on without, `file` and line with it.
using TakeWarning = std::function<void(const Error&)>;

/// Orders of VDA 5050 as robots go: the first order of each, then, for each `state` message of a
/// robot (one line of JSON), an update for each robot that may go on. An update begins with the
/// last node that was released before, as VDA 5050 asks. Returns at the end of `states`, when all
/// have arrived, or when `take` says so.
///
/// A broker carries what it likes: lines that are empty or no state message, and states of robots
/// that are not in the plan or follow another order, are passed over and counted. `warn` hears of
/// the first one of each kind at once, and of all together at the end. States that are older than
/// known, and those of robots without any order, are passed over in silence. Error (with `file` and
/// line): a node that the robot had no release for.
[[nodiscard]] std::optional<Error> release_orders(const OrderWriter& writer,
                                                  const execution::Precedences& order,
                                                  std::istream& states, const std::string& file,
                                                  const TakeOrder& take, const TakeWarning& warn);

}  // namespace quadrille::exports

QUADRILLE_API_END
