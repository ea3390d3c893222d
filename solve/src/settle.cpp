// SPDX-License-Identifier: MIT
#include "quadrille/solve/settle.hpp"

#include <utility>

namespace quadrille::solve {
namespace {

/// Whether not all can be true together.
bool contradict(const Facts& facts) noexcept {
  if (facts.infeasible) return facts.given || facts.cost;
  const auto is_too_cheap = [&](const std::optional<Cost>& cost) {
    return cost && *cost < facts.lower();  // which is no less than what is claimed
  };
  return is_too_cheap(facts.cost) || is_too_cheap(facts.given);
}

/// What it is that cannot.
std::optional<Error> find_contradiction(const Facts& facts) {
  const auto internal = [](std::string message) {
    return Error{ErrorCode::internal, std::move(message), {}};
  };
  if (facts.infeasible && (facts.given || facts.cost))
    return internal("infeasible, but a plan is known");
  for (const auto& cost : {facts.cost, facts.given})
    if (cost)
      if (auto refused = refuse_bound(facts.claimed, *cost)) return refused;
  for (const auto& cost : {facts.cost, facts.given})
    if (cost && *cost < facts.lower())
      return internal("a plan costs " + std::to_string(*cost) + " and the proven bound is " +
                      std::to_string(facts.lower()));
  return std::nullopt;
}

std::string text_of(StopReason reason) {
  if (reason == StopReason::memory) return "no more memory";  // short: needs no memory itself
  return "stopped by the limit: " + std::string(to_string(reason));
}

}  // namespace

std::optional<Error> refuse_bound(Cost claimed, Cost cost) {
  if (cost >= claimed) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "the known lower bound is wrong: it is " + std::to_string(claimed) +
                   ", and a plan costs " + std::to_string(cost),
               {}};
}

Settlement settle(Facts facts, std::optional<double> wanted_gap) {
  Settlement settled;
  if (!facts.error) facts.error = find_contradiction(facts);
  if (facts.error) {
    settled.stop = facts.stop;
    settled.explanation = facts.error->message;
    settled.error = std::move(facts.error);
    return settled;
  }
  if (facts.infeasible) {
    settled.status = Status::infeasible;
    settled.explanation = std::move(facts.infeasible->why);
    return settled;
  }
  settled.rests_on_claim =
      facts.claimed > facts.floor && std::max(facts.floor, facts.raised) <= facts.claimed;
  if (facts.cost == facts.lower()) {
    settled.status = Status::optimal;
    return settled;
  }
  settled.status = facts.cost ? Status::feasible : Status::unknown;
  settled.stop = facts.stop;
  if (facts.cost && is_within_gap(wanted_gap, *facts.cost, facts.lower()))
    settled.stop = StopReason::gap;
  if (settled.stop == StopReason::none)
    settled.explanation =
        facts.why_open.empty() ? "the search ended without a proof" : std::move(facts.why_open);
  else if (settled.status == Status::unknown)
    settled.explanation = text_of(settled.stop);
  return settled;
}

// Without the texts, which take memory: it is asked where there may be none.
bool is_proof(const Facts& facts, std::optional<double> wanted_gap) noexcept {
  if (facts.error || contradict(facts)) return false;
  if (facts.infeasible || facts.cost == facts.lower()) return true;
  return facts.cost && is_within_gap(wanted_gap, *facts.cost, facts.lower());
}

}  // namespace quadrille::solve
