// SPDX-License-Identifier: MIT
// Options outside their ranges are errors of the caller, with a reason, and never an answer.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "quadrille/discrete/solver.hpp"

namespace quadrille::discrete {
namespace {

Instance line() {
  return Instance::make(Graph::grid(3, 1, {true, true, true}), {{VertexId(0), VertexId(2)}})
      .value();
}

struct Refused {
  std::string reason;
  ErrorCode code;
  std::function<void(SolveOptions&)> make;
};

TEST(SolveOptions, OutsideTheirRangesAreErrorsWithAReason) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  using Kind = CheckSchedule::Kind;
  const std::vector<Refused> all{
      {"gap", ErrorCode::out_of_range, [](auto& o) { o.gap_percent = -0.5; }},
      {"gap", ErrorCode::out_of_range, [&](auto& o) { o.gap_percent = not_a_number; }},
      {"threads", ErrorCode::out_of_range, [](auto& o) { o.threads = 0; }},
      {"threads", ErrorCode::out_of_range, [](auto& o) { o.threads = 65; }},
      {"seed", ErrorCode::out_of_range, [](auto& o) { o.seed = 2'000'000'001; }},
      {"progress", ErrorCode::out_of_range, [](auto& o) { o.progress_interval_s = -1; }},
      {"progress", ErrorCode::out_of_range, [&](auto& o) { o.progress_interval_s = not_a_number; }},
      {"fractions", ErrorCode::out_of_range,
       [](auto& o) {
         o.mdd.check = {Kind::fractions, {{1, 1}}};
       }},
      {"fractions", ErrorCode::out_of_range,
       [](auto& o) {
         o.mdd.check = {Kind::fractions, {{1, 2}, {1, 3}}};
       }},
      {"fractions", ErrorCode::out_of_range,
       [](auto& o) {
         o.mdd.check = {Kind::fractions, {{1, 0}}};
       }},
      {"initial plan", ErrorCode::invalid_plan, [](auto& o) { o.initial_plan = Plan(); }},
      {"known plan", ErrorCode::invalid_plan, [](auto& o) { o.debug.known_plan = Plan(); }},
  };
  for (const Refused& refused : all)
    for (const std::size_t threads : {1U, 2U}) {
      SolveOptions options;
      options.threads = threads;
      refused.make(options);
      const auto outcome = solve(line(), options);
      ASSERT_FALSE(outcome) << refused.reason;
      EXPECT_EQ(outcome.error().code, refused.code);
      EXPECT_NE(outcome.error().message.find(refused.reason), std::string::npos)
          << outcome.error().message;
    }
  EXPECT_TRUE(solve(line(), {}));
}

}  // namespace
}  // namespace quadrille::discrete
