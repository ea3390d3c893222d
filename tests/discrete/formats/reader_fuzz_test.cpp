// SPDX-License-Identifier: MIT
//
// Readers get valid files with random damage. Whatever they get, they return a value or an error;
// what they accept is written and read back without a change. QUADRILLE_TEST_SCALE multiplies the
// number of cases.
#include <cstdlib>
#include <functional>

#include "discrete/formats/io_support.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/verify.hpp"

namespace quadrille::discrete {
namespace {

std::uint64_t num_cases() {
  const char* scale = std::getenv("QUADRILLE_TEST_SCALE");
  const double factor = scale == nullptr ? 1 : std::strtod(scale, nullptr);
  return static_cast<std::uint64_t>(std::max(1.0, 3000 * factor));
}

/// Text that is likely to matter to some format.
const std::vector<std::string> kSnippets = {
    "\0",    "\n",          "\r\n",  "\t",
    " ",     "-1",          "0",     "99999999999999999999",
    "1e400", "\"",          "'",     "[",
    "]",     "{",           "}",     "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    ",",     ":",           "?",     "? ",
    "- ",    "&a ",         "*a",    "!!python/tuple ",
    "!",     "%YAML 9.9\n", "---\n", "...\n",
    "|",     ">",           "#",     "\xef\xbb\xbf",
    "\xff",  "\\u0000",     "null",  "~",
    "<<: ",  "@",           "`",     ".",
    "(",     ")",           "->",    "Agent 0: "};

std::string damaged(std::string text, std::mt19937_64& random) {
  const auto below = [&random](std::size_t bound) {
    return random() % std::max<std::size_t>(bound, 1);
  };
  for (std::size_t hits = 1 + below(4); hits > 0; --hits) {
    const std::size_t at = below(text.size() + 1), length = below(12);
    switch (below(7)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(below(text.size() + 1), length));
        break;
      case 3:
        text.insert(at, kSnippets[below(kSnippets.size())]);
        break;
      case 4:
        text.replace(at, length, kSnippets[below(kSnippets.size())]);
        break;
      default:
        if (at < text.size())
          text[at] = static_cast<char>(below(5) == 0 ? below(256) : 32 + below(95));
    }
  }
  return text;
}

/// Runs one reader on damaged versions of each file. `read` returns whether the text was accepted.
void fuzz(const std::vector<std::string>& files, const std::function<bool(std::istream&)>& read) {
  std::uint64_t accepted = 0;
  const std::uint64_t cases = num_cases();
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    std::mt19937_64 random(seed);
    const std::string text =
        damaged(testing::text_of(testing::data("valid/" + files[seed % files.size()])), random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ":\n" + text);
    std::istringstream in(text);
    if (read(in)) ++accepted;
    if (::testing::Test::HasFailure()) return;
  }
  ::testing::Test::RecordProperty("accepted", static_cast<int>(accepted));
}

/// An error that a user can work with.
bool is_clear(const Error& error) {
  EXPECT_EQ(error.where.file, "fuzz");
  EXPECT_FALSE(error.message.empty());
  EXPECT_LT(error.message.size(), 1000u);
  for (const char c : error.message) EXPECT_TRUE(c >= ' ' && c <= '~') << error.message;
  EXPECT_NE(error.code, ErrorCode::internal) << error.message;
  return false;
}

TEST(ReaderFuzz, Maps) {
  fuzz({"small.map", "small-crlf.map"}, [](std::istream& in) {
    const auto map = read_map(in, "fuzz", {"SW", ""});
    if (!map) return is_clear(map.error());
    std::stringstream copy;
    EXPECT_EQ(write_map(copy, "copy", *map), std::nullopt);
    EXPECT_EQ(read_map(copy, "copy").value().passable, map->passable);
    return true;
  });
}

TEST(ReaderFuzz, Scenarios) {
  const auto graph =
      std::make_shared<const Graph>(read_map(testing::data("valid/small.map")).value().graph());
  fuzz({"small.scen", "small-crlf.scen", "blanks.scen"}, [&](std::istream& in) {
    const auto scenario = read_scenario(in, "fuzz");
    if (!scenario) return is_clear(scenario.error());
    std::stringstream copy;
    EXPECT_EQ(write_scenario(copy, "copy", *scenario), std::nullopt);
    EXPECT_EQ(read_scenario(copy, "copy").value().rows.size(), scenario->rows.size());
    const auto instance = make_instance(graph, *scenario, 2);
    return instance ? true : is_clear(instance.error());
  });
}

using ReadInstance = Result<Instance>(std::istream&, const std::string&, std::size_t, text::Names*);

template <class Write>
void fuzz_instances(const std::vector<std::string>& files, ReadInstance* read, Write write) {
  fuzz(files, [&](std::istream& in) {
    text::Names names, again;
    const auto instance = read(in, "fuzz", SIZE_MAX, &names);
    if (!instance) return is_clear(instance.error());
    std::stringstream copy;
    EXPECT_EQ(write(copy, "copy", *instance, names), std::nullopt);
    EXPECT_TRUE(testing::equal(read(copy, "copy", SIZE_MAX, &again).value(), *instance));
    // YAML has a name for every agent.
    for (std::size_t i = 0; i < names.agents.size(); ++i) {
      const std::string* const name = names.agent(i);
      if (name != nullptr) {
        EXPECT_EQ(again.agents[i], *name);
      }
    }
    return true;
  });
}

TEST(ReaderFuzz, JsonInstances) {
  fuzz_instances({"grid.json", "graph.json"}, read_instance_json, write_instance_json);
}

TEST(ReaderFuzz, YamlInstances) {
  fuzz_instances({"grid.yaml"}, read_instance_yaml, write_instance_yaml);
}

TEST(ReaderFuzz, Plans) {
  const Instance instance = read_instance_json(testing::data("valid/grid.json")).value();
  fuzz({"plan.json", "result.json", "plan.cbsh2", "plan.visualizer", "plan.yaml"},
       [&](std::istream& in) {
         const auto file = read_plan(in, "fuzz", instance.graph());
         if (!file) return is_clear(file.error());
         std::stringstream copy;
         EXPECT_EQ(write_plan(copy, "copy", instance.graph(), file->plan, PlanFormat::json),
                   std::nullopt);
         EXPECT_EQ(read_plan(copy, "copy", instance.graph()).value().plan, file->plan);
         EXPECT_GE(verify(instance, file->plan).sum_of_costs, 0);
         return true;
       });
}

}  // namespace
}  // namespace quadrille::discrete
