// SPDX-License-Identifier: MIT
// What quadrille-check exports is checked by programs of its own, and each claim is refuted.
#include "exports/export.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "check/cases.hpp"
#include "check/support.hpp"
#include "support/environment.hpp"

namespace quadrille_check {
namespace {

namespace support = quadrille::discrete::support;

TEST(Export, IsARefutationInBothFormats) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("quadrille_export_test_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const std::string scripts = QUADRILLE_TEST_SCRIPTS;
  std::string pseudo_boolean = "python3 " + scripts + "/pseudo_boolean.py", lrat;
  for (std::uint64_t seed = 7000; seed < 7000 + quadrille::support::scaled(40); ++seed) {
    SCOPED_TRACE(seed);
    support::Case drawn = support::draw(seed);
    if (seed % 4 == 0) drawn.options.limits.conflicts = 5;
    const auto outcome = support::solve_at(drawn.instance, drawn.options, drawn.pace);
    if (!outcome.certificate->claim) continue;
    const std::string& bytes = outcome.certificate->bytes;
    const Instance instance = quadrille_check::support::checked(drawn.instance);
    Checker checker(instance);
    for (const Record& record : quadrille_check::support::records_of(bytes)) checker.check(record);
    const auto file = [&](const char* end) {
      return (folder / (std::to_string(seed) + end)).string();
    };
    ASSERT_TRUE(export_pb(bytes, checker, file(".opb"), file(".pbp")));
    ASSERT_TRUE(export_lrat(bytes, file(".cnf"), file(".lrat")));
    pseudo_boolean += " " + file(".opb") + " " + file(".pbp");
    lrat += "python3 " + scripts + "/lrat.py " + file(".cnf") + " " + file(".lrat") + " && ";
  }
  EXPECT_EQ(std::system(pseudo_boolean.c_str()), 0);
  EXPECT_EQ(std::system((lrat + "true").c_str()), 0);
  if (std::getenv("QUADRILLE_KEEP_EXPORTS") == nullptr) std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace quadrille_check
