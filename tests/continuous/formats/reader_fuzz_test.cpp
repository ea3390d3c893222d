// SPDX-License-Identifier: MIT
//
// Files with random damage: a reader says what is wrong, or finds a valid instance or plan.
// QUADRILLE_TEST_SCALE multiplies the number of files.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "continuous/formats/file_support.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/nav_graph.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/roadmap_xml.hpp"
#include "quadrille/continuous/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::continuous {
namespace {

std::string damaged(std::string text, std::mt19937_64& random) {
  const char* const bits[] = {"<",   ">",    "\"", "/",  "-",       "e",   "9999999999", "nan",
                              "0",   "[",    "]",  "{",  "}",       ",",   "null",       "1e308",
                              "\n",  "&lt;", "&",  ".5", "<!--",    "-->", "<![CDATA[",  "]]>",
                              "\\u", "\xff", "%",  "-0", "<?xml?>", "''",  "true",       "0x1"};
  for (std::size_t count = 1 + random() % 3; count > 0; --count) {
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
      case 0:
        text.erase(at, 1 + random() % 9);
        break;
      case 1:
        text.insert(at, bits[random() % std::size(bits)]);
        break;
      case 2:
        text[at] = static_cast<char>(random() % 256);
        break;
      default:
        text.insert(at, text.substr(random() % text.size(), random() % 40));
    }
    if (text.empty()) return "x";
  }
  return text;
}

/// `read` gets the damaged text and says whether it was accepted; errors name the file.
template <class Read>
void survive(const std::string& name, const Read& read) {
  const std::string text = test::contents(test::data(name));
  std::mt19937_64 random(7);
  std::size_t accepted = 0;
  const std::size_t num_files = support::scaled(3000);
  for (std::size_t n = 0; n < num_files; ++n) {
    const std::string file = damaged(text, random);
    SCOPED_TRACE(file);
    std::istringstream in(file);
    const std::optional<Error> error = read(in);
    accepted += error ? 0 : 1;
    if (!error) continue;
    ASSERT_EQ(error->where.file, "f");
    ASSERT_FALSE(error->message.empty());
    ASSERT_EQ(error->message.find('\n'), std::string::npos) << error->message;
  }
  if (num_files < 100) return;
  // Both happen: the damage is neither always harmless nor always fatal.
  EXPECT_GT(accepted, 0u);
  EXPECT_LT(accepted, num_files);
}

template <class T>
std::optional<Error> error_of(const Result<T>& result) {
  return result ? std::nullopt : std::optional(result.error());
}

TEST(RoadmapReaderFuzz, Maps) {
  for (const char* name : {"roadmap.xml", "cells.xml"})
    survive(name, [](std::istream& in) {
      const auto map = read_map_xml(in, "f", 1e-6);
      if (map) {
        if (const auto* cells = std::get_if<OccupancyGrid>(&map->map)) {
          (void)GridRoadmap::make(*cells, 5, 353'553, 1e-6);
        }
      }
      return error_of(map);
    });
}

TEST(RoadmapReaderFuzz, NavGraphs) {
  survive("nav.yaml", [](std::istream& in) {
    return error_of(read_nav_graph(in, "f", {Resolution{1e-3}, kUnitSpeed}));
  });
}

TEST(RoadmapReaderFuzz, Tasks) {
  const Roadmap roadmap =
      Roadmap::make(std::vector<Point>{{0, 0}, {9, 0}, {18, 0}, {27, 0}}, {}).value();
  survive("tasks.xml", [&](std::istream& in) {
    const auto task = read_task_xml(in, "f");
    if (task) (void)agents_of(*task, task->rows.size(), roadmap, 1, kUnitSpeed);
    return error_of(task);
  });
}

TEST(RoadmapReaderFuzz, Instances) {
  survive("discs.json", [](std::istream& in) {
    const auto instance = read_instance_json(in, "f");
    if (instance) {
      std::ostringstream out;
      EXPECT_EQ(write_instance_json(out, "out", *instance), std::nullopt);
    }
    return error_of(instance);
  });
}

TEST(RoadmapReaderFuzz, Plans) {
  const Instance instance = read_instance_json(test::data("discs.json")).value();
  for (const char* name : {"discs-plan.json", "discs-log.xml"})
    survive(name, [&](std::istream& in) {
      const auto file = read_plan(in, "f", instance);
      if (file) (void)verify(instance, file->plan);  // takes any plan, however broken
      return error_of(file);
    });
}

}  // namespace
}  // namespace quadrille::continuous
