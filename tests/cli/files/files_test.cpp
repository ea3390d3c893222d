// SPDX-License-Identifier: MIT
// What the program writes it can read: random instances of both domains, random options of all
// commands, and every file that comes of them read by every command that takes its kind.
// QUADRILLE_TEST_SCALE multiplies the number of instances.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/files/files_case.hpp"
#include "support/environment.hpp"

namespace quadrille::cli::test {
namespace {

constexpr std::uint64_t kShards = 4, kCases = 300;
/// Cases that showed faults once.
constexpr std::uint64_t kFound[] = {0};

class Files : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Files, WhatIsWrittenCanBeRead) {
  for (std::uint64_t n = 0; n < support::scaled(kCases / kShards); ++n) {
    const std::uint64_t seed = GetParam() * 1'000'000 + n;
    const std::string problem = FilesCase(seed).problem();
    ASSERT_TRUE(problem.empty()) << "files seed " << seed << ": " << problem;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Files, testing::Range<std::uint64_t>(0, kShards));

TEST(FilesAgain, SeedsThatFailedOnce) {
  for (const std::uint64_t seed : kFound) {
    const std::string problem = FilesCase(seed).problem();
    EXPECT_TRUE(problem.empty()) << "files seed " << seed << ": " << problem;
  }
}

}  // namespace
}  // namespace quadrille::cli::test
