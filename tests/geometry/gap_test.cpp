// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "geometry/cases.hpp"
#include "geometry/oracle.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

using boost::multiprecision::cpp_rational;
using oracle::BigInteger;

TEST(Gap, KnownValues) {
  const BodyPair pair(Disc{10}, Disc{10});
  const Motion through{{-100, 0}, {100, 0}, 200};
  const auto beside = [&](Length y) { return *pair.gap(through, rest({0, y}, 200), 0); };
  EXPECT_NEAR(beside(25).at_least, 5, 1e-10);
  EXPECT_NEAR(beside(25).at_most, 5, 1e-10);
  EXPECT_EQ(beside(20).at_most, 0);  // Touching, and exactly so.
  EXPECT_EQ(beside(19).at_most, 0);
  EXPECT_GT(beside(21).at_least, 0);
  EXPECT_FALSE(pair.gap(through, rest({0, 0}, 5), 201).has_value());
  EXPECT_FALSE(pair.gap(through, rest({0, 0}, 5), -6).has_value());

  const auto square = ConvexPolygon::make({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}).value();
  const BodyPair squares(square, square);
  EXPECT_NEAR(squares.gap(rest({0, 0}, 1), rest({5, 6}, 1), 0)->at_least, 5, 1e-12);
  EXPECT_EQ(squares.gap(rest({0, 0}, 1), rest({2, 1}, 1), 0)->at_most, 0);
  const BodyPair mixed(square, Disc{5});
  EXPECT_NEAR(mixed.gap(rest({0, 0}, 1), rest({7, 9}, 1), 0)->at_most, 5, 1e-12);
}

// (bound + reach)^2 against the exact squared distance, in rational numbers.
template <class Generator>
void expect_enclosure(Generator generate) {
  int apart = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const Case c = generate(random);
    const Ticks offset = draw_ticks(random, -c.b.duration, c.a.duration);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", offset " << offset << ": " << c);
    const oracle::Oracle<BigInteger> oracle(c.body_a, c.a, c.body_b, c.b);
    const BodyPair pair(c.body_a, c.body_b);
    const std::optional<Gap> gap = pair.gap(c.a, c.b, offset);
    ASSERT_TRUE(gap.has_value());
    if (oracle.collide(offset)) {
      EXPECT_EQ(gap->at_most, 0);
      continue;
    }
    ++apart;
    const auto square = oracle.squared_distance(offset);
    const cpp_rational exact(square.numerator,
                             square.denominator * oracle.scale() * oracle.scale());
    const Length reach = std::get<Disc>(c.body_a).radius + std::get<Disc>(c.body_b).radius;
    const cpp_rational low = cpp_rational(gap->at_least) + reach.value();
    const cpp_rational high = cpp_rational(gap->at_most) + reach.value();
    EXPECT_LE(low * low, exact);
    EXPECT_GE(high * high, exact);
    const double largest = static_cast<double>((8 * kMaxLength).value());
    EXPECT_LE(gap->at_most - gap->at_least, 1e-13 * largest);
    EXPECT_EQ(gap->at_most == 0, exact == cpp_rational(BigInteger(reach.value()) * reach.value()));
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(apart, 500);
}

TEST(Gap, BoundsOfDiscsEncloseTheExactDistance) { expect_enclosure(hard_discs); }
TEST(Gap, BoundsOfBallsEncloseTheExactDistance) { expect_enclosure(hard_balls); }

}  // namespace
}  // namespace quadrille::geometry
