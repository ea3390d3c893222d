// SPDX-License-Identifier: MIT
#include "quadrille/geometry/body_index.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "cases.hpp"
#include "quadrille/geometry/body_pair.hpp"
#include "support/environment.hpp"

namespace quadrille::geometry {
namespace {

using support::Random;

struct Standing {
  Body body;
  Point place;
};

/// Few large bodies among many small ones, in a square of twice `size` or a cube.
std::vector<Standing> random_bodies(Random& random, Length size, bool is_flat) {
  std::vector<Standing> bodies;
  for (std::size_t n = random.between(1, 60); n > 0; --n) {
    const Length reach = draw(random, 1, random.percent(10) ? size / 2 : 1 + size / 20);
    Body body = Disc{reach};
    if (is_flat && reach > 3 && random.percent(50)) body = random_polygon(random, reach);
    bodies.push_back({std::move(body),
                      {draw(random, -size, size), draw(random, -size, size),
                       is_flat ? Length(0) : draw(random, -size, size)}});
  }
  return bodies;
}

TEST(BodyIndex, FindsWhatALookAtAllFinds) {
  Random random(1);
  std::size_t num_found = 0, num_free = 0;
  for (std::size_t round = 0; round < support::scaled(200); ++round) {
    const Length size = round % 3 == 0 ? kMaxLength : Length(std::int64_t{40} << round % 20);
    const std::vector<Standing> bodies = random_bodies(random, size, round % 4 != 0);
    BodyIndex index;
    for (std::size_t j = 0; j < bodies.size(); ++j) {
      const auto& [body, place] = bodies[j];
      std::optional<std::size_t> first;
      for (std::size_t i = 0; i < j && !first; ++i)
        if (bodies_overlap(bodies[i].body, bodies[i].place, body, place)) first = i;
      ASSERT_EQ(index.first_overlap(body, place), first);
      ++(first ? num_found : num_free);
      index.add(j, body, place);
    }
  }
  EXPECT_GT(num_found, 100U);
  EXPECT_GT(num_free, 100U);
}

TEST(BodyIndex, TouchingIsNoOverlap) {
  BodyIndex index;
  index.add(7, Disc{5}, {0, 0});
  EXPECT_EQ(index.first_overlap(Disc{5}, {10, 0}), std::nullopt);
  EXPECT_EQ(index.first_overlap(Disc{5}, {9, 0}), 7U);
  EXPECT_EQ(index.first_overlap(Disc{5}, {0, 0, 10}), std::nullopt);
  EXPECT_EQ(index.first_overlap(Disc{5}, {0, 0, 9}), 7U);
}

}  // namespace
}  // namespace quadrille::geometry
