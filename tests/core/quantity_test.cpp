// SPDX-License-Identifier: MIT
#include "quadrille/core/quantity.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>
#include <vector>

namespace quadrille {
namespace {

using Apples = Quantity<struct AppleUnit>;
using Pears = Quantity<struct PearUnit>;

template <class A, class B>
concept Adds = requires(A a, B b) {
  a + b;
};
template <class A, class B>
concept Subtracts = requires(A a, B b) {
  a - b;
};
template <class A, class B>
concept Compares = requires(A a, B b) {
  a < b;
};
template <class A, class B>
concept Equates = requires(A a, B b) {
  a == b;
};
template <class A, class B>
concept Multiplies = requires(A a, B b) {
  a* b;
};
template <class A, class B>
concept Divides = requires(A a, B b) {
  a / b;
};
template <class A, class B>
concept Assigns = requires(A a, B b) {
  a = b;
};
template <class A, class B>
concept AddsTo = requires(A a, B b) {
  a += b;
};

// What belongs together.
static_assert(Adds<Apples, Apples> && Subtracts<Apples, Apples> && AddsTo<Apples, Apples>);
static_assert(Compares<Apples, Apples> && Equates<Apples, Apples> && Assigns<Apples, Apples>);
static_assert(std::is_same_v<decltype(Apples() + Apples()), Apples>);
static_assert(std::is_same_v<decltype(Apples() * 2L), Apples>);
static_assert(std::is_same_v<decltype(2L * Apples()), Apples>);
static_assert(std::is_same_v<decltype(Apples() / 2L), Apples>);
static_assert(std::is_same_v<decltype(Apples() / Apples(1)), std::int64_t>);
static_assert(std::is_constructible_v<Apples, std::int64_t>);

// What does not: two units.
static_assert(!Adds<Apples, Pears> && !Subtracts<Apples, Pears> && !AddsTo<Apples, Pears>);
static_assert(!Compares<Apples, Pears> && !Equates<Apples, Pears> && !Assigns<Apples, Pears>);
static_assert(!Multiplies<Apples, Pears> && !Multiplies<Apples, Apples> && !Divides<Apples, Pears>);
static_assert(!std::is_constructible_v<Apples, Pears>);

// Or a unit and a number that the program computes.
template <class Number>
constexpr bool is_kept_apart =
    !Adds<Apples, Number> && !Adds<Number, Apples> && !Subtracts<Apples, Number> &&
    !Compares<Apples, Number> && !Equates<Apples, Number> && !Assigns<Apples, Number> &&
    !AddsTo<Apples, Number> && !Assigns<Number&, Apples> &&
    !std::is_convertible_v<Number, Apples> && !std::is_convertible_v<Apples, Number>;
static_assert(is_kept_apart<std::int64_t>);
static_assert(is_kept_apart<std::size_t>);
static_assert(is_kept_apart<std::uint32_t>);
static_assert(is_kept_apart<double>);
static_assert(!std::is_constructible_v<Apples, double>);
static_assert(!std::is_constructible_v<std::int64_t, Apples>);
static_assert(!std::is_constructible_v<bool, Apples>);

// It costs what an integer costs.
static_assert(sizeof(Apples) == sizeof(std::int64_t) && std::is_trivially_copyable_v<Apples>);

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

TEST(Quantity, CountsLikeAnInteger) {
  for (const std::int64_t a : {-7L, -1L, 0L, 2L, kMost / 4})
    for (const std::int64_t b : {-3L, 1L, 7L, kMost / 4}) {
      SCOPED_TRACE(testing::Message() << a << ", " << b);
      const Apples x(a), y(b);
      EXPECT_EQ((x + y).value(), a + b);
      EXPECT_EQ((x - y).value(), a - b);
      EXPECT_EQ((-x).value(), -a);
      EXPECT_EQ(abs(x).value(), std::abs(a));
      EXPECT_EQ((x * 3).value(), a * 3);
      EXPECT_EQ((-3 * x).value(), -3 * a);
      EXPECT_EQ((x / 2).value(), a / 2);
      EXPECT_EQ(x / y, a / b);
      EXPECT_EQ(x < y, a < b);
      EXPECT_EQ(x == y, a == b);
      Apples sum = x;
      sum += y;
      EXPECT_EQ(sum, x + y);
      sum -= x;
      EXPECT_EQ(sum, y);
      sum *= 2;
      EXPECT_EQ(sum, y + y);
      EXPECT_EQ((++sum).value(), 2 * b + 1);
    }
  EXPECT_EQ(Apples(kMost).value(), kMost);
  EXPECT_EQ(Apples(-kMost - 1).value(), -kMost - 1);
}

TEST(Quantity, TakesLiterals) {
  constexpr Apples three = 3;
  static_assert(three - 1 == Apples(2) && three > 0 && -three == -3 && Apples() == 0);
  const std::vector<Apples> all{1, 2, three};
  EXPECT_EQ(all.back(), three);
  const std::optional<Apples> none = all.empty() ? std::optional(three) : std::nullopt;
  EXPECT_EQ(none.value_or(Apples{5}).value(), 5);
}

TEST(Quantity, IsPrintedAsANumber) {
  std::ostringstream out;
  out << Apples(-12) << ' ' << Apples(kMost);
  EXPECT_EQ(out.str(), "-12 9223372036854775807");
}

}  // namespace
}  // namespace quadrille
