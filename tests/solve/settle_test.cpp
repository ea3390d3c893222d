// SPDX-License-Identifier: MIT
// The decision table of docs/cli.md, row by row: the same for both domains.
#include "quadrille/solve/settle.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace quadrille::solve {
namespace {

constexpr auto kNone = StopReason::none;
constexpr auto kWall = StopReason::wall_time;
const std::optional<Cost> kNoPlan;

struct Row {
  std::string name;
  Facts facts;
  std::optional<double> gap;
  Status status;
  StopReason stop;
  std::string explanation;  ///< Contained in it; "": it is empty.
  std::optional<ErrorCode> error;
};

Facts bounds(Cost floor, std::optional<Cost> cost, StopReason stop = kNone) {
  Facts facts;
  facts.floor = floor;
  facts.cost = cost;
  facts.stop = stop;
  return facts;
}
template <class Change>
Facts but(Facts facts, const Change& change) {
  change(facts);
  return facts;
}

std::vector<Row> rows() {
  const auto is_blocked = [](Facts& f) { f.infeasible = Infeasibility{"a corridor"}; };
  const auto has_failed = [](Facts& f) { f.error = Error{ErrorCode::internal, "a lemma", {}}; };
  const auto claims = [](Cost claim) { return [claim](Facts& f) { f.claimed = claim; }; };
  const auto gives = [](Cost cost) { return [cost](Facts& f) { f.given = cost; }; };
  const auto raised = [](Cost bound) { return [bound](Facts& f) { f.raised = bound; }; };
  constexpr auto kInternal = ErrorCode::internal;
  constexpr auto kRefused = ErrorCode::out_of_range;
  using enum Status;
  return {
      // What the search says of itself.
      {"bounds meet", bounds(7, 7), {}, optimal, kNone, "", {}},
      {"they meet when a limit is met", bounds(7, 7, kWall), {}, optimal, kNone, "", {}},
      {"they meet when memory is over",
       bounds(7, 7, StopReason::memory),
       {},
       optimal,
       kNone,
       "",
       {}},
      {"by a search", but(bounds(5, 7), raised(7)), {}, optimal, kNone, "", {}},
      {"a limit, with a plan", bounds(5, 7, kWall), {}, feasible, kWall, "", {}},
      {"a limit, without one",
       bounds(5, kNoPlan, kWall),
       {},
       unknown,
       kWall,
       "limit: wall-time",
       {}},
      {"memory, with a plan",
       bounds(5, 7, StopReason::memory),
       {},
       feasible,
       StopReason::memory,
       "",
       {}},
      {"memory, without one",
       bounds(5, kNoPlan, StopReason::memory),
       {},
       unknown,
       StopReason::memory,
       "no more memory",
       {}},
      {"close enough", bounds(5, 7, StopReason::gap), 40, feasible, StopReason::gap, "", {}},
      {"close enough at a limit", bounds(5, 7, kWall), 40, feasible, StopReason::gap, "", {}},
      {"not close enough", bounds(5, 7, kWall), 39, feasible, kWall, "", {}},
      {"no proof, no limit, no plan",
       but(bounds(5, kNoPlan), [](Facts& f) { f.why_open = "too far"; }),
       {},
       unknown,
       kNone,
       "too far",
       {}},
      {"no proof, no limit, a plan",
       but(bounds(5, 9), [](Facts& f) { f.why_open = "too far"; }),
       {},
       feasible,
       kNone,
       "too far",
       {}},
      {"a limit says more than that",
       but(bounds(5, 9, kWall), [](Facts& f) { f.why_open = "too far"; }),
       {},
       feasible,
       kWall,
       "",
       {}},
      {"there is no plan",
       but(bounds(0, kNoPlan), is_blocked),
       {},
       infeasible,
       kNone,
       "a corridor",
       {}},
      {"nor when a limit is met",
       but(bounds(0, kNoPlan, kWall), is_blocked),
       {},
       infeasible,
       kNone,
       "a corridor",
       {}},
      // What contradicts itself.
      {"an audit fails", but(bounds(7, 7), has_failed), {}, unknown, kNone, "a lemma", kInternal},
      {"when memory is over, too",
       but(bounds(7, 7, StopReason::memory), has_failed),
       {},
       unknown,
       StopReason::memory,
       "a lemma",
       kInternal},
      {"a plan below the bound",
       bounds(8, 7),
       {},
       unknown,
       kNone,
       "a plan costs 7 and the proven bound is 8",
       kInternal},
      {"no plan, but one was found",
       but(bounds(5, 7), is_blocked),
       {},
       unknown,
       kNone,
       "infeasible, but a plan is known",
       kInternal},
      // What the user knows.
      {"a claim is reached", but(bounds(5, 7), claims(7)), {}, optimal, kNone, "", {}},
      {"a claim is not reached", but(bounds(5, 9, kWall), claims(7)), {}, feasible, kWall, "", {}},
      {"a claim is wrong",
       but(bounds(5, 7), claims(8)),
       {},
       unknown,
       kNone,
       "the known lower bound is wrong: it is 8, and a plan costs 7",
       kRefused},
      {"a claim is wrong, as a given plan shows",
       but(but(bounds(5, 9, kWall), claims(8)), gives(7)),
       {},
       unknown,
       kWall,
       "it is 8, and a plan costs 7",
       kRefused},
      {"an audit fails and a claim is wrong",
       but(but(bounds(5, 7), claims(8)), has_failed),
       {},
       unknown,
       kNone,
       "a lemma",
       kInternal},
      {"nobody has to believe a claim here",
       but(but(bounds(0, kNoPlan), is_blocked), claims(8)),
       {},
       infeasible,
       kNone,
       "a corridor",
       {}},
      {"a given plan fits", but(bounds(7, 7), gives(9)), {}, optimal, kNone, "", {}},
      {"a given plan is cheaper than the bound",
       but(bounds(8, 9, kWall), gives(7)),
       {},
       unknown,
       kWall,
       "a plan costs 7 and the proven bound is 8",
       kInternal},
      {"no plan, but one was given",
       but(but(bounds(0, kNoPlan), is_blocked), gives(7)),
       {},
       unknown,
       kNone,
       "infeasible, but a plan is known",
       kInternal},
  };
}

TEST(Settle, EachRowOfTheTable) {
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    const Settlement settled = settle(row.facts, row.gap);
    EXPECT_EQ(settled.status, row.status) << to_string(settled.status);
    EXPECT_EQ(settled.stop, row.stop) << to_string(settled.stop);
    EXPECT_EQ(settled.explanation.empty(), row.explanation.empty()) << settled.explanation;
    EXPECT_NE(settled.explanation.find(row.explanation), std::string::npos) << settled.explanation;
    EXPECT_EQ(settled.error.has_value(), row.error.has_value());
    if (settled.error && row.error) {
      EXPECT_EQ(settled.error->code, *row.error);
    }
    const bool is_proof_here =
        !row.error && (row.status == Status::optimal || row.status == Status::infeasible ||
                       row.stop == StopReason::gap);
    EXPECT_EQ(is_proof(row.facts, row.gap), is_proof_here);
  }
}

// As if nothing were known that nothing was found out, a sentence says so.
TEST(Settle, UnknownIsNeverWithoutAReason) { EXPECT_NE(settle({}, std::nullopt).explanation, ""); }

TEST(Settle, WhatRestsOnAClaimSaysSo) {
  struct Case {
    Cost floor, claimed, raised;
    bool rests;
  };
  for (const Case& c : {Case{5, 7, 0, true}, Case{5, 7, 7, true}, Case{5, 7, 8, false},
                        Case{7, 7, 0, false}, Case{8, 7, 8, false}, Case{5, 0, 5, false}}) {
    Facts facts = bounds(c.floor, 9, kWall);
    facts.claimed = c.claimed;
    facts.raised = c.raised;
    EXPECT_EQ(settle(facts, std::nullopt).rests_on_claim, c.rests)
        << c.floor << " " << c.claimed << " " << c.raised;
    facts.cost.reset();
    facts.infeasible = Infeasibility{"a corridor"};
    EXPECT_FALSE(settle(facts, std::nullopt).rests_on_claim);
  }
}

}  // namespace
}  // namespace quadrille::solve
