// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrille/core/attribution.hpp"
#include "quadrille/core/internal_error.hpp"
#include "quadrille/core/limits.hpp"
#include "quadrille/core/statistics.hpp"
#include "quadrille/solve/settle.hpp"

namespace quadrille::solve {

/// All that a solve has found out so far: the only state that its outcome is made of. A search that
/// is cut short anywhere, and be it for want of memory, leaves what it knew before: plans are
/// replaced as wholes.
template <class Plan>
struct Knowledge : Facts {
  std::shared_ptr<const Plan> plan;  ///< The cheapest one; null if there is none.
  std::optional<Attribution> attribution;
  Statistics statistics;
  bool has_floor = false;  ///< What the agents cost when each is alone is known.

  /// By a search that may have begun from the user's claim.
  void raise(Cost bound) noexcept { raised = std::max(raised, bound); }
  /// Whatever the user claims.
  void prove(Cost bound) noexcept {
    floor = std::max(floor, bound);
    has_floor = true;
  }
  void take(std::shared_ptr<const Plan> better, Cost its_cost) noexcept {
    plan = std::move(better);
    cost = its_cost;
  }
  /// Keeps a plan that is cheaper; true if so.
  bool offer(std::shared_ptr<const Plan> other, Cost its_cost) noexcept {
    if (cost && its_cost >= *cost) return false;
    take(std::move(other), its_cost);
    return true;
  }
  /// Says where the plan came from if it is the first one.
  void credit(std::string_view source) {
    if (plan && statistics.first_plan.empty()) statistics.first_plan = source;
  }
  void drop_plan() noexcept {
    plan.reset();
    cost.reset();
  }
  void fail(std::string message) { error = Error{ErrorCode::internal, std::move(message), {}}; }
};

/// Does a part of a solve. That a limit, the memory or a contradiction ended it is known
/// afterwards; the last two are caught nowhere else. What `work` throws besides comes out.
template <class Plan, class Work>
void run_guarded(Knowledge<Plan>& known, LimitMonitor& limits, const Work& work) {
  try {
    work();
  } catch (const LimitReached&) {
  } catch (const InternalError& error) {
    if (!known.error) known.fail(error.message);
  } catch (const std::bad_alloc&) {
    // What the work held is free again.
    known.stop = StopReason::memory;
  }
  if (known.stop == StopReason::none) known.stop = limits.reason();
}

/// What several searches of one instance know together, not empty; `winner` has a proof. A plan
/// that refutes the user's claim is the answer, because the others may have trusted the claim; then
/// an error of any of them, because it has to be seen, and because a proof may rest on what the
/// others told. Otherwise that is the proof, or the cheapest plan with the largest bound. Searches
/// that never asked a SAT solver have the statistics of the first one, which did that for them.
template <class Plan>
[[nodiscard]] Knowledge<Plan> merged(std::vector<Knowledge<Plan>> all,
                                     std::optional<std::size_t> winner) {
  for (Knowledge<Plan>& known : all)
    if (known.is_claim_refuted() && !known.error) return std::move(known);
  for (Knowledge<Plan>& known : all)
    if (known.error) return std::move(known);
  const Statistics first = all.front().statistics;
  std::size_t best = 0;
  Cost floor = 0, raised = 0;
  // Who only made plans ends when the others do, whatever ended these.
  StopReason stop = StopReason::none;
  std::string why_open;
  for (std::size_t w = 0; w < all.size(); ++w) {
    if (stop == StopReason::none) stop = all[w].stop;
    if (why_open.empty()) why_open = all[w].why_open;
    floor = std::max(floor, all[w].floor);
    raised = std::max(raised, all[w].raised);
    if (all[w].cost && (!all[best].cost || *all[w].cost < *all[best].cost)) best = w;
  }
  Knowledge<Plan> answer = std::move(all[winner.value_or(best)]);
  const std::string own = answer.statistics.first_plan;
  if (!winner || answer.statistics.sat_calls == 0) answer.statistics = first;
  answer.statistics.first_plan = first.first_plan.empty() ? own : first.first_plan;
  if (winner) return answer;
  if (floor > 0) answer.prove(floor);
  answer.raised = raised;
  answer.stop = stop;
  answer.why_open = std::move(why_open);
  return answer;
}

}  // namespace quadrille::solve
