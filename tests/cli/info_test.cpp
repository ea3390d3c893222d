// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "cli/process.hpp"
#include "support/sanitizer.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

using InfoTest = CliTest;

/// The lines "map", "components" and "degrees".
std::string shape(const std::string& out) {
  std::string lines;
  std::istringstream in(out);
  for (std::string line; std::getline(in, line);)
    for (const char* name : {"map ", "components ", "degrees "})
      if (line.starts_with(name)) lines += line + "\n";
  return lines;
}

TEST_F(InfoTest, AMapAloneIsDescribedLikeItsGraph) {
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const std::string size = std::to_string(1 + seed % 7);
    const std::vector<std::string> generate = {"generate",
                                               "--kind",
                                               "random",
                                               "--seed",
                                               std::to_string(seed),
                                               "--width",
                                               size,
                                               "--height",
                                               std::to_string(1 + seed % 5),
                                               "--obstacles",
                                               seed % 3 == 0 ? "0.6" : "0.3",
                                               "--map-output",
                                               path("m.map"),
                                               "--scen-output",
                                               path("m.scen"),
                                               "--agents",
                                               "0"};
    ASSERT_EQ(run(generate).code, 0);
    const Finished map = run({"info", "--map", path("m.map")});
    const Finished graph = run({"info", "--map", path("m.map"), "--scen", path("m.scen")});
    EXPECT_EQ(map.code, 0) << map.err;
    EXPECT_EQ(graph.code, 0) << graph.err;
    EXPECT_EQ(shape(map.out), shape(graph.out));
    EXPECT_THAT(map.out, HasSubstr("degrees "));
  }
}

TEST_F(InfoTest, TheLargestMapTakesSecondsAndLessThanAGigabyte) {
  if (support::kAddressSanitizer)
    GTEST_SKIP() << "the sanitizer needs more address space than any limit leaves";
  constexpr std::size_t kSide = 8192;
  std::string text = "type octile\nheight 8192\nwidth 8192\nmap\n";
  for (std::size_t row = 0; row < kSide; ++row) {
    // Walls with a gap at alternate ends: one long way.
    std::string cells(kSide, row % 2 == 0 ? '.' : '@');
    if (row % 2 == 1) cells[row % 4 == 1 ? 0 : kSide - 1] = '.';
    text += cells + "\n";
  }
  write("large.map", text);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  const rlimit gigabyte{1'000'000'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &gigabyte), 0);
  Process process(folder_, {"info", "--map", path("large.map")});
  const Finished finished = process.wait(10);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("8192 x 8192 grid, 33558528 vertices, 33558527 edges\n"
                                      "components 1, of 33558528 vertices\n"));
}

}  // namespace
}  // namespace quadrille::cli::test
