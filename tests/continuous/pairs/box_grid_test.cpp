// SPDX-License-Identifier: MIT
//
// What the grid finds against a look at all boxes, and how few it looks at.
#include "pairs/box_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "continuous/support/random_instance.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous::test {
namespace {

Box random_box(Draw& draw, std::int64_t size, std::int64_t extent) {
  const Length left = draw.length(Length(-size), Length(size));
  const Length bottom = draw.length(Length(-size), Length(size));
  return {left, left + draw.length(0, Length(extent)), bottom,
          bottom + draw.length(0, Length(extent))};
}

TEST(BoxGrid, FindsAllThatAreNearOnce) {
  BoxGrid grid;  // one for all: what is left of the last boxes must not matter
  int found = 0, missed = 0;
  for (std::uint32_t seed = 0; seed < support::scaled(1500); ++seed) {
    Draw draw(seed);
    const std::int64_t size = draw.number(0, 1) == 0 ? 20 : 1'000'000'000;
    std::vector<Box> boxes;
    for (std::int64_t k = draw.number(0, 40); k > 0; --k)
      boxes.push_back(random_box(draw, size, draw.chance(80) ? size / 10 : size));
    const Length reach = draw.length(1, Length(size / 5));
    grid.fill(boxes, reach);
    for (int tried = 0; tried < 20; ++tried) {
      // Some are far outside of all the others.
      const Box box = random_box(draw, draw.chance(80) ? size : 4 * size, size / 5);
      std::vector<std::uint32_t> near;
      grid.visit_near(box, reach, [&](std::uint32_t k) { near.push_back(k); });
      std::sort(near.begin(), near.end());
      std::vector<std::uint32_t> expected;
      for (std::uint32_t k = 0; k < boxes.size(); ++k)
        if (!are_far(boxes[k], box, reach)) expected.push_back(k);
      ASSERT_EQ(near, expected) << "seed " << seed;
      found += static_cast<int>(near.size());
      missed += static_cast<int>(boxes.size() - near.size());
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(missed, found);
}

// Ten times as many moves in ten times the room: as many are near each of them.
TEST(BoxGrid, LooksAtThoseNearBy) {
  for (const std::int64_t count : {1'000, 10'000}) {
    Draw draw(1);
    std::vector<Box> boxes;
    for (std::int64_t k = 0; k < count; ++k) {
      const Length left = draw.length(0, Length(100 * count)), bottom = draw.length(0, 1'000);
      boxes.push_back({left, left + draw.length(50, 150), bottom, bottom + draw.length(50, 150)});
    }
    BoxGrid grid;
    grid.fill(boxes, 50);
    for (const Box& box : boxes) grid.visit_near(box, 50, [](std::uint32_t) {});
    EXPECT_LT(grid.num_looks(), 20 * count);
  }
}

}  // namespace
}  // namespace quadrille::continuous::test
