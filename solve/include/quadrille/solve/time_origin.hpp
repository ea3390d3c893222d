// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/outcome.hpp"
#include "quadrille/solve/frame.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::solve {

/// Of an outcome whose plan is none: an internal error, as in Frame.
template <class Outcome>
void refuse_plan(Outcome& outcome, const std::string& violation) {
  outcome.internal_error = Error{ErrorCode::internal, "the plan is not valid: " + violation, {}};
  outcome.explanation = outcome.internal_error->message;
  outcome.status = Status::unknown;
  outcome.stop = StopReason::none;
  outcome.plan.reset();
  outcome.cost.reset();
  outcome.attribution.reset();
}

/// The border between the times of users, which are absolute, and those of searches, which begin at
/// 0. Of an instance that begins later, searches see the one whose times count from its `now`; no
/// time of a user's comes further than to this function. What crosses: the plans that are given,
/// those that are told, and the plan and the collision sites of the outcome. Costs and bounds count
/// from `now` on both sides.
///
/// `search(instance, options)` is the solve, from the request to the outcome, of an instance that
/// begins at 0. `Border` is what the domain knows:
///
///     begins_at_0()               there is nothing to convert
///     instance(), since_now()     that of the user, and what searches see
///     verify(plan)                its replay, of the user's instance
///     enter(plan), leave(plan)    change the times of a plan to those of searches, and back
///     now()                       as a cost, which collision sites have for times
template <class Border, class Options, class Search>
[[nodiscard]] auto search_from_0(const Border& border, const Options& options, const Search& search)
    -> decltype(search(border.instance(), options)) {
  if (border.begins_at_0()) return search(border.instance(), options);
  // What is wrong with plans that are given is said in the user's times.
  const auto verify = [&](const auto& plan) { return border.verify(plan); };
  if (auto error = check_request(options, verify)) return *std::move(error);
  Options inner = options;
  for (auto* const plan : {&inner.initial_plan, &inner.debug.known_plan})
    if (*plan) border.enter(**plan);
  if (options.on_plan)
    inner.on_plan = [&](auto plan) {
      border.leave(plan);
      options.on_plan(plan);
    };
  auto outcome = search(border.since_now(), inner);
  if (!outcome) return outcome;
  if (outcome->attribution)
    for (CollisionSite& site : outcome->attribution->sites) {
      site.begin += border.now();
      if (site.end != CollisionSite::kForever) site.end += border.now();
    }
  if (!outcome->plan) return outcome;
  border.leave(*outcome->plan);
  // It has been replayed in the times of searches; nothing is given out unless it stands in those
  // of the user.
  const auto report = border.verify(*outcome->plan);
  if (!report.valid()) refuse_plan(*outcome, report.violations.front().message);
  return outcome;
}

}  // namespace quadrille::solve

QUADRILLE_API_END
