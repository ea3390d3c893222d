// SPDX-License-Identifier: MIT
// The theory of lazy path models inside the engine, with a domain as small as can be, whose answers
// follow from Hall's theorem.
#include "quadrille/lazy/theory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "lazy/seats.hpp"
#include "quadrille/core/internal_error.hpp"
#include "support/environment.hpp"
#include "support/random.hpp"

namespace quadrille::lazy::test {
namespace {

using quadrille::support::Random;
using quadrille::support::scaled;
using sat::Verdict;

/// Whether agents with these caps can sit apart: those with a cap of at most k are at most k + 1.
bool can_sit(const std::vector<Cost>& caps, int num_seats) {
  for (Cost k = 0; k < num_seats; ++k) {
    const auto count = std::count_if(caps.begin(), caps.end(), [&](Cost cap) {
      return std::min<Cost>(cap, num_seats - 1) <= k;
    });
    if (count > k + 1) return false;
  }
  return true;
}

template <class Habits>
class LazyTheory : public testing::Test {
 protected:
  static constexpr bool kDiscrete = Habits::value;

  void make(std::size_t num_agents, int num_seats, Fault fault = Fault::none) {
    num_seats_ = num_seats;
    vocabulary_.emplace(num_agents, !kDiscrete);
    theory_.emplace(limits_, *vocabulary_, num_agents, num_seats, fault);
    engine_.emplace(&*theory_);
    writer_.emplace(*engine_);
  }
  [[nodiscard]] Verdict solve(const std::vector<Cost>& caps) {
    std::vector<sat::Lit> assumptions;
    for (std::size_t i = 0; i < caps.size(); ++i)
      if (caps[i] < kNoCap)
        assumptions.push_back(~vocabulary_->above(AgentId(i), caps[i], *writer_));
    return engine_->solve(assumptions, limits_);
  }
  void expect_good(const std::vector<int>& seats, const std::vector<Cost>& caps) const {
    for (std::size_t i = 0; i < caps.size(); ++i) {
      EXPECT_LE(seats[i], caps[i]);
      EXPECT_LT(seats[i], num_seats_);
      EXPECT_EQ(std::count(seats.begin(), seats.end(), seats[i]), 1);
    }
  }

  LimitMonitor limits_{Limits{}};
  int num_seats_ = 0;
  std::optional<SeatVocabulary> vocabulary_;
  std::optional<SeatTheory<kDiscrete>> theory_;
  std::optional<sat::Engine> engine_;
  std::optional<EngineWriter> writer_;
};

using Habits = testing::Types<std::true_type, std::false_type>;
TYPED_TEST_SUITE(LazyTheory, Habits);

TYPED_TEST(LazyTheory, FindsAPlanWithinTheCapsOrThatThereIsNone) {
  int num_plans = 0, num_refuted = 0;
  for (std::uint64_t seed = 0; seed < scaled(300) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t num_agents = 1 + random.below(6);
    const int num_seats = static_cast<int>(1 + random.below(7));
    this->make(num_agents, num_seats);
    for (int question = 0; question < 6; ++question) {
      std::vector<Cost> caps;
      for (std::size_t i = 0; i < num_agents; ++i)
        caps.push_back(static_cast<Cost>(random.below(7)));
      const bool is_possible = can_sit(caps, num_seats);
      ASSERT_EQ(this->solve(caps), is_possible ? Verdict::sat : Verdict::unsat);
      ++(is_possible ? num_plans : num_refuted);
      if (!is_possible) {
        // The core alone cannot be kept.
        std::vector<Cost> of_core(num_agents, kNoCap);
        for (const sat::Lit lit : this->engine_->core()) {
          const auto meaning = this->vocabulary_->variable(lit);
          EXPECT_FALSE(this->vocabulary_->is_at_least(lit));
          of_core[meaning.agent.index()] = meaning.cost - 1;
        }
        EXPECT_FALSE(can_sit(of_core, num_seats));
        continue;
      }
      ASSERT_TRUE(this->theory_->accepted());
      this->expect_good(*this->theory_->accepted(), caps);
    }
  }
  if (scaled(300) < 300) return;  // too few to count on chance
  EXPECT_GT(num_plans, 100);
  EXPECT_GT(num_refuted, 100);
}

TYPED_TEST(LazyTheory, AgentsWithoutACapAreAbsentWhereTheDomainSaysSo) {
  this->make(3, 2);
  EXPECT_EQ(this->solve({1, 1, kNoCap}), this->kDiscrete ? Verdict::sat : Verdict::unsat);
  if (this->kDiscrete) {
    EXPECT_FALSE(this->theory_->accepted());
  }
}

TYPED_TEST(LazyTheory, CountsItsChecksAndTellsTheDomain) {
  this->make(4, 4);
  EXPECT_EQ(this->solve({3, 3, 3, 3}), Verdict::sat);
  EXPECT_GT(this->theory_->num_checks(), 1);
  EXPECT_GT(this->theory_->domain().num_partings, 0);
  EXPECT_LE(this->theory_->domain().num_partings, this->theory_->num_checks());
  EXPECT_EQ(this->solve({2, 2, 2, 2}), Verdict::unsat);
  EXPECT_GT(this->theory_->domain().num_explained, 0);
  EXPECT_GT(this->theory_->effort(), Effort());
}

TYPED_TEST(LazyTheory, ACollisionThatItsClauseDoesNotExcludeIsAnInternalError) {
  for (const Fault fault : {Fault::wrong_seat, Fault::silent}) {
    this->make(2, 3, fault);
    EXPECT_THROW(static_cast<void>(this->solve({2, 2})), InternalError);
  }
}

}  // namespace
}  // namespace quadrille::lazy::test
