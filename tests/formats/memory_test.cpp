// SPDX-License-Identifier: MIT
//
// Large files of other programs: no reader takes more memory than 20 times the file.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <new>
#include <optional>
#include <sstream>
#include <string>

#include "formats/plan_samples.hpp"
#include "formats/samples.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"

namespace {

std::size_t held = 0, most_held = 0;

void* allocate_or_null(std::size_t size) noexcept {
  void* const memory = std::malloc(std::max<std::size_t>(size, 1));
  if (memory == nullptr) return nullptr;
  held += malloc_usable_size(memory);
  most_held = std::max(most_held, held);
  return memory;
}
void* allocate(std::size_t size) {
  void* const memory = allocate_or_null(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void release(void* memory) noexcept {
  if (memory == nullptr) return;
  held -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
// std::stable_sort takes its buffer by these.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate_or_null(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate_or_null(size);
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }

namespace quadrille::formats {
namespace {

/// Bytes that the call holds at most, besides those that are held before it.
std::size_t most_held_in(const std::function<void()>& call) {
  const std::size_t before = held;
  most_held = held;
  call();
  return most_held - before;
}

void expect_little(const std::string& name, const std::string& text,
                   const std::function<std::optional<Error>(std::istream&)>& read) {
  std::istringstream in(text);
  std::optional<Error> error;
  const std::size_t most = most_held_in([&] { error = read(in); });
  EXPECT_EQ(error, std::nullopt) << name << ": " << error->to_string();
  EXPECT_LE(most, 20 * text.size()) << name << " of " << text.size() << " bytes";
  testing::Test::RecordProperty(name, static_cast<int>(10 * most / text.size()));
}

template <class T>
std::optional<Error> error_of(const Result<T>& result) {
  return result ? std::nullopt : std::optional(result.error());
}

constexpr std::size_t kPlaces = 20'000;

TEST(FormatsMemory, Roadmaps) {
  Places places;
  Edges edges;
  for (std::size_t v = 0; v < kPlaces; ++v) {
    places.push_back({geometry::Length(static_cast<std::int64_t>(1000 * (v % 200))),
                      geometry::Length(static_cast<std::int64_t>(1000 * (v / 200)))});
    if (v > 0) edges.emplace_back(v - 1, v);
    if (v >= 200) edges.emplace_back(v - 200, v);
  }
  const auto read = [](std::istream& in) {
    return error_of(
        continuous::read_map_file(in, "f", {continuous::Resolution{1e-3}, continuous::kUnitSpeed}));
  };
  expect_little("graphml", graphml_of(places, edges), read);
  expect_little("gml", gml_of(places, edges), read);
  expect_little("geojson", route_graph_of(places, edges), read);
  expect_little("lif", lif_of(places, edges), read);
  expect_little("nav_graph", nav_graph_of(places, edges), read);
}

TEST(FormatsMemory, Plans) {
  const discrete::Instance instance = crossing();
  const auto read = [&](std::istream& in) { return error_of(read_plan(in, "f", instance)); };
  std::string lns2 = "Agent 0:", csv = "2d", moves = "D,D", schedule;
  std::string lacam = kLacam.substr(0, kLacam.find("soc=")) + "solution=\n";
  for (std::size_t t = 0; t < kPlaces; ++t) {
    const std::string y = std::to_string(std::min<std::size_t>(t, 2));
    lns2 += "(" + y + ",1)->";
    moves += ",W";
    csv += "w";
    schedule += ", {t: " + std::to_string(t + 3) + ", x: 1, y: 2}";
    lacam += std::to_string(t) + ":(1," + y + "),(" + std::to_string(std::min<std::size_t>(t, 3)) +
             ",1),\n";
  }
  expect_little("lns2", lns2 + "\nAgent 1:(1,0)->(1,1)->(1,2)->(1,3)->\n", read);
  expect_little("planviz",
                "{\"actionModel\": \"MAPF\", \"teamSize\": 2, \"start\": [[0, 1, \"N/A\"], [1, 0, "
                "\"N/A\"]], \"actualPaths\": [\"" +
                    moves + "\", \"R,R,R\"]}",
                read);
  expect_little("tracker",
                "map_name,scen_type,type_id,agents,lower_cost,solution_cost,solution_plan\n"
                "m,even,1,2,5,5,\"" +
                    csv + "\n3r\"\n",
                read);
  expect_little("lacam", lacam, read);
}

}  // namespace
}  // namespace quadrille::formats
