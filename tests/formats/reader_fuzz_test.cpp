// SPDX-License-Identifier: MIT
//
// Files of other programs with random damage: readers say what is wrong, in one line that names the
// file, or take what is left. QUADRILLE_TEST_SCALE multiplies the number of mutants.
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <random>
#include <sstream>

#include "formats/plan_samples.hpp"
#include "formats/samples.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/continuous/plan_files.hpp"
#include "quadrille/continuous/verify.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/verify.hpp"
#include "support/environment.hpp"

namespace quadrille::formats {
namespace {

std::string damaged(std::string text, std::mt19937_64& random) {
  const char* const bits[] = {
      "<", ">",  "\"", "-",  "e9",   "9999999999",   "nan",       "0",     "[",
      "]", "{",  "}",  ",",  "null", "\n",           ":",         "1e308", "true",
      "'", "=",  "->", "(",  ")",    "\xEF\xBB\xBF", "\\u00",     "\xff",  "-0",
      "#", "  ", "n1", "/>", "<!--", "&lt;",         "99999999r", "\r"};
  for (std::uint64_t count = 1 + random() % 4; count > 0 && !text.empty(); --count) {
    const std::size_t at = random() % text.size(), length = random() % 40;
    const std::size_t from = random() % text.size();
    switch (random() % 5) {
      case 0:
        text.erase(at, 1 + length / 4);
        break;
      case 1:
        text.insert(at, bits[random() % std::size(bits)]);
        break;
      case 2:
        text[at] = static_cast<char>(random() % 256);
        break;
      case 3:
        text.resize(at);
        break;
      default:
        text.insert(at, text.substr(from, length));
    }
  }
  return text;
}

/// `read`: gives the error, or nothing if the text was accepted.
void survive(const std::string& sample,
             const std::function<std::optional<Error>(std::istream&)>& read) {
  std::istringstream whole(sample);
  ASSERT_EQ(read(whole), std::nullopt) << sample;
  std::mt19937_64 random(11);
  std::size_t accepted = 0;
  const std::size_t num_files = support::scaled(1000);
  for (std::size_t n = 0; n < num_files; ++n) {
    const std::string file = damaged(sample, random);
    std::istringstream in(file);
    const auto error = read(in);
    accepted += error ? 0 : 1;
    if (!error) continue;
    ASSERT_EQ(error->where.file, "f") << file;
    ASSERT_FALSE(error->message.empty()) << file;
    ASSERT_LT(error->message.size(), 1000u) << file;
    ASSERT_NE(error->code, ErrorCode::internal) << file;
    ASSERT_EQ(error->message.find('\n'), std::string::npos) << file;
  }
  if (num_files < 1000) return;  // too few to say what is to be expected
  EXPECT_GT(accepted, 0u) << sample;
  EXPECT_LT(accepted, num_files) << sample;
}

template <class T>
std::optional<Error> error_of(const Result<T>& result) {
  return result ? std::nullopt : std::optional(result.error());
}

TEST(FormatsFuzz, Roadmaps) {
  for (const std::string& sample :
       {kLif, kRouteGraph, kNetworkx, kOmplInSpace, kYed, kGml, kNavGraph})
    survive(sample, [&](std::istream& in) {
      continuous::MapFileOptions options{continuous::Resolution{1e-3}, continuous::kUnitSpeed};
      if (sample == kNavGraph) options.level = "L1";
      return error_of(continuous::read_map_file(in, "f", options));
    });
}

TEST(FormatsFuzz, Plans) {
  const discrete::Instance instance = crossing();
  for (const std::string& sample : {kLns2, kLacam, kPlanViz, kTracker, kAtb033})
    survive(sample, [&](std::istream& in) {
      const auto file = read_plan(in, "f", instance);
      if (file) {
        EXPECT_GE(verify(instance, file->plan).sum_of_costs, 0);
      }
      return error_of(file);
    });
}

TEST(FormatsFuzz, RoadmapsWithAgents) {
  survive(kLibmrpRoadmap,
          [](std::istream& in) { return error_of(discrete::read_instance_yaml(in, "f")); });
}

TEST(FormatsFuzz, Logs) {
  std::istringstream json(kSidingJson);
  const continuous::Instance instance = continuous::read_instance_json(json, "i").value();
  survive(kLogWithPlaces, [&](std::istream& in) {
    const auto file = continuous::read_plan(in, "f", instance);
    if (file) (void)verify(instance, file->plan);
    return error_of(file);
  });
}

}  // namespace
}  // namespace quadrille::formats
