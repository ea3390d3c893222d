// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/discrete/generator.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/discrete/plan.hpp"

namespace quadrille::discrete::testing {

inline std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(QUADRILLE_TEST_DATA) / name;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in.is_open()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A place to write to that takes `capacity` characters and then fails, like a full disk.
class FullDisk : public std::streambuf {
 public:
  explicit FullDisk(std::size_t capacity) : left_(capacity) {}

 protected:
  int_type overflow(int_type c) override {
    if (left_ == 0) return traits_type::eof();
    --left_;
    return traits_type::not_eof(c);
  }

 private:
  std::size_t left_;
};

/// Checks that a writer reports a disk that is full at once, or in the middle, as io with the file.
template <class Write>
void expect_reports_full_disk(Write write) {
  for (const std::size_t capacity : {0u, 10u}) {
    FullDisk disk(capacity);
    std::ostream out(&disk);
    const std::optional<Error> error = write(out);
    ASSERT_TRUE(error.has_value()) << capacity;
    EXPECT_EQ(error->code, ErrorCode::io);
    EXPECT_EQ(error->where.file, "out");
  }
  if (std::ofstream full("/dev/full"); full.is_open()) {
    const std::optional<Error> error = write(full);
    ASSERT_TRUE(error.has_value()) << "/dev/full";
    EXPECT_EQ(error->code, ErrorCode::io);
  }
}

inline bool equal(const Graph& a, const Graph& b) {
  if (a.num_vertices() != b.num_vertices() || a.num_edges() != b.num_edges()) return false;
  if (a.layout().has_value() != b.layout().has_value()) return false;
  if (a.layout() &&
      (a.layout()->width() != b.layout()->width() || a.layout()->height() != b.layout()->height()))
    return false;
  for (const VertexId v : IdRange<VertexId>(a.num_vertices())) {
    if (a.layout() && a.layout()->cell_of(v) != b.layout()->cell_of(v)) return false;
    const auto near_a = a.neighbours(v), near_b = b.neighbours(v);
    if (!std::equal(near_a.begin(), near_a.end(), near_b.begin(), near_b.end())) return false;
  }
  return true;
}

inline bool equal(const Instance& a, const Instance& b) {
  return equal(a.graph(), b.graph()) && a.agents() == b.agents();
}

inline Instance random_grid_instance(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto size = [&] { return static_cast<std::int32_t>(1 + random() % 7); };
  const double share = static_cast<double>(random() % 5) / 10;
  const GridMap map = random_map(size(), size(), share, seed).value();
  const auto agents = random() % static_cast<std::uint64_t>(map.num_passable() + 1);
  const Scenario scenario = random_scenario(map, agents, seed, {}).value();
  return make_instance(std::make_shared<const Graph>(map.graph()), scenario, agents).value();
}

inline Instance random_graph_instance(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::size_t count = random() % 8;
  std::vector<Graph::Edge> edges;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      if (random() % 3 == 0) edges.emplace_back(VertexId(a), VertexId(b));
  std::vector<Agent> tasks;
  for (std::size_t i = 0; i < count; i += 1 + random() % 2)
    tasks.push_back({VertexId(i), random() % 3 == 0 ? Goals({VertexId(count - 1 - i), VertexId(0)})
                                                    : Goals(VertexId(count - 1 - i))});
  return Instance::make(Graph::make(count, edges).value(), std::move(tasks)).value();
}

/// One path per agent that may be anything but empty.
inline Plan random_plan(const Graph& graph, std::size_t agents, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Plan plan;
  for (std::size_t i = 0; i < agents; ++i) {
    Path path(1 + random() % 6);
    for (VertexId& v : path) v = VertexId(random() % graph.num_vertices());
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

}  // namespace quadrille::discrete::testing
