// SPDX-License-Identifier: MIT
#include "quadrille/discrete/generator.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "discrete/formats/io_support.hpp"

namespace quadrille::discrete {
namespace {

std::string drawing(const GridMap& map) {
  std::string text;
  for (std::int32_t y = 0; y < map.height; ++y) {
    for (std::int32_t x = 0; x < map.width; ++x) text += map.is_passable({x, y}) ? '.' : '@';
    text += '\n';
  }
  return text;
}

std::vector<ScenarioRow> random_rows(const GridMap& map, std::size_t agents, std::uint64_t seed) {
  return random_scenario(map, agents, seed).value().rows;
}

std::size_t num_reachable(const Graph& graph) {
  std::size_t count = 0;
  for (const Timestep d : distances_from(graph, VertexId(0))) count += d == kUnreachable ? 0u : 1u;
  return count;
}

TEST(Generator, IsTheSameOnEveryPlatform) {
  // Written down once; the generator may only change on purpose.
  EXPECT_EQ(drawing(random_map(6, 3, 0.3, 1).value()), "....@@\n....@@\n..@...\n");
  EXPECT_EQ(drawing(maze_map(7, 5, 1, 1).value()), ".......\n@@@@@@.\n...@...\n.@@@.@@\n.......\n");
  EXPECT_EQ(drawing(room_map(8, 5, 2, 0.5, 1).value()),
            "..@.....\n.....@..\n@.@@@@.@\n..@..@..\n........\n");
  std::string rows;
  for (const ScenarioRow& row : random_rows(empty_map(4, 4).value(), 3, 1))
    rows += std::to_string(row.start.x) + "," + std::to_string(row.start.y) + "-" +
            std::to_string(row.goal.x) + "," + std::to_string(row.goal.y) + " ";
  EXPECT_EQ(rows, "0,2-2,3 1,3-2,2 2,1-1,2 ");
}

TEST(Generator, RandomMapsHaveTheAskedShareOfObstacles) {
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    EXPECT_EQ(random_map(10, 10, 0.25, seed).value().num_passable(), 75);
  EXPECT_EQ(random_map(3, 3, 0, 1).value().num_passable(), 9);
  EXPECT_EQ(random_map(3, 3, 1, 1).value().num_passable(), 0);
  EXPECT_NE(random_map(10, 10, 0.25, 1).value(), random_map(10, 10, 0.25, 2).value());
}

TEST(Generator, RandomMapsBlockEveryCellEquallyOften) {
  std::vector<int> blocked(6, 0);
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const GridMap map = random_map(3, 2, 0.5, seed).value();
    for (std::size_t i = 0; i < 6; ++i) blocked[i] += map.passable[i] ? 0 : 1;
  }
  // 1500 expected, standard deviation 27.
  for (const int count : blocked) EXPECT_NEAR(count, 1500, 150);
}

TEST(Generator, MazesAreTrees) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Graph graph = maze_map(15, 11, 1, seed).value().graph();
    EXPECT_EQ(graph.num_edges() + 1, graph.num_vertices());
    EXPECT_EQ(num_reachable(graph), graph.num_vertices());
    EXPECT_EQ(graph.num_vertices(), 2u * (8 * 6) - 1);
  }
}

TEST(Generator, WideMazesAndRoomsAreConnected) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto size = static_cast<std::int32_t>(1 + seed % 4);
    const GridMap maze = maze_map(19, 16, size, seed).value();
    EXPECT_EQ(num_reachable(maze.graph()), maze.graph().num_vertices());
    const GridMap rooms = room_map(19, 16, size, 0.3, seed).value();
    EXPECT_EQ(num_reachable(rooms.graph()), rooms.graph().num_vertices());
    const GridMap all = room_map(19, 16, size, 1, seed).value();
    const auto columns = 20 / (size + 1), rows = 17 / (size + 1);
    EXPECT_EQ(all.num_passable(),
              columns * rows * size * size + (columns - 1) * rows + columns * (rows - 1));
    EXPECT_EQ(room_map(19, 16, size, 0, seed).value().num_passable(),
              columns * rows * size * size + columns * rows - 1);
  }
}

TEST(Generator, WarehousesHaveShelvesAndAisles) {
  EXPECT_EQ(drawing(warehouse_map({2, 2, 3, 1, 1, 2}).value()),
            "@@@@@@@@@@@@@\n"
            "@...........@\n"
            "@..@@@.@@@..@\n"
            "@...........@\n"
            "@..@@@.@@@..@\n"
            "@...........@\n"
            "@@@@@@@@@@@@@\n");
  const GridMap benchmark = warehouse_map({}).value();
  EXPECT_EQ(benchmark.width, 161);
  EXPECT_EQ(benchmark.height, 63);
  EXPECT_EQ(benchmark.num_passable(), 5699);
}

TEST(Generator, RefusesWhatIsOutOfRange) {
  constexpr std::int32_t kMax = INT32_MAX;
  const WarehouseLayout huge{kMax, kMax, kMax, kMax, kMax, kMax};
  for (const auto& map :
       {empty_map(0, 3), empty_map(3, -1), empty_map(kMax, kMax), empty_map(1 << 14, 1 << 13),
        random_map(3, 3, -0.1, 1), random_map(3, 3, 1.1, 1), random_map(3, 3, std::nan(""), 1),
        maze_map(3, 3, 0, 1), maze_map(3, 4, 4, 1), maze_map(kMax, kMax, kMax, 1),
        room_map(4, 3, 4, 0, 1), room_map(3, 3, 1, 2, 1), room_map(3, 3, 1, std::nan(""), 1),
        warehouse_map(huge), warehouse_map({1, 1, 1, 1, 1, -1}), warehouse_map({1, 1, 1, 1, 0, 1}),
        warehouse_map({1 << 20, 1 << 20, 1, 1, 1, 1})}) {
    const bool refused = !map.has_value();
    // 2^27 cells are too many, everything else is wrong by itself.
    ASSERT_TRUE(refused);
    EXPECT_EQ(map.error().code, ErrorCode::out_of_range);
  }
  EXPECT_EQ(random_scenario(empty_map(2, 2).value(), 1, 0, {true, "a b"}).error().code,
            ErrorCode::out_of_range);
}

TEST(Generator, ScenariosAreInstancesThatCanBeWalked) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const GridMap map = random_map(9, 7, 0.4, seed).value();
    const auto agents = static_cast<std::size_t>(map.num_passable());
    const Scenario scenario = random_scenario(map, agents, seed).value();
    // make_instance refuses equal starts and equal goals.
    const Instance instance =
        make_instance(std::make_shared<const Graph>(map.graph()), scenario, agents).value();
    for (const Agent& task : instance.agents())
      EXPECT_NE(distances_from(instance.graph(), task.start)[task.goal()], kUnreachable);
  }
}

TEST(Generator, ScenariosMayAskForTheUnreachable) {
  GridMap map = empty_map(3, 1).value();
  map.passable[1] = false;
  bool crossed = false;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const ScenarioRow apart = random_scenario(map, 1, seed, {false, "m"}).value().rows[0];
    crossed |= apart.start != apart.goal;
    const ScenarioRow row = random_scenario(map, 1, seed).value().rows[0];
    EXPECT_EQ(row.start, row.goal);
  }
  EXPECT_TRUE(crossed);
  EXPECT_EQ(random_scenario(map, 3, 0).error().code, ErrorCode::invalid_instance);
  EXPECT_TRUE(random_scenario(map, 2, 0).has_value());
}

TEST(Generator, StatesTheOctileLength) {
  GridMap map = empty_map(3, 3).value();
  map.passable[4] = false;  // A post in the middle: no corner may be cut.
  bool seen = false;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const ScenarioRow& row : random_rows(map, 8, seed)) {
      const auto dx = std::abs(row.start.x - row.goal.x), dy = std::abs(row.start.y - row.goal.y);
      // Around the post every way is straight.
      const bool opposite = (dx == 2 && row.start.y == 1 && row.goal.y == 1) ||
                            (dy == 2 && row.start.x == 1 && row.goal.x == 1);
      EXPECT_EQ(row.optimal, opposite ? 4 : dx + dy);
      EXPECT_EQ(row.bucket, opposite || dx + dy == 4 ? 1 : 0);
      seen |= opposite;
    }
  EXPECT_TRUE(seen);
  const GridMap open = empty_map(9, 9).value();
  for (const ScenarioRow& row : random_rows(open, 81, 1)) {
    const auto dx = std::abs(row.start.x - row.goal.x), dy = std::abs(row.start.y - row.goal.y);
    EXPECT_NEAR(row.optimal, std::abs(dx - dy) + std::min(dx, dy) * std::sqrt(2.0), 1e-12);
  }
}

}  // namespace
}  // namespace quadrille::discrete
