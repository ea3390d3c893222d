// SPDX-License-Identifier: MIT
// An address space that is too small: whatever fails first, the program says so and ends properly.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>

#include "cli/process.hpp"
#include "frame/exit_codes.hpp"
#include "support/sanitizer.hpp"

namespace quadrille::cli::test {
namespace {

using testing::AnyOf;
using testing::Eq;
using testing::HasSubstr;

class MemoryTest : public CliTest {
 protected:
  /// The exit code under `ulimit -v`; what was written is in `out` and `err`.
  int run_within(int mib, const std::string& arguments) {
    const std::string command = "ulimit -v " + std::to_string(mib * 1024) + "; exec '" +
                                QUADRILLE_PROGRAM + "' " + arguments + " --quiet --json - >'" +
                                path("out") + "' 2>'" + path("err") + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  void expect_proper_end(int mib, const std::string& arguments) {
    SCOPED_TRACE(std::to_string(mib) + " MiB, " + arguments);
    const int code = run_within(mib, arguments);
    const std::string err = read("err");
    if (code == 127 && err.find("shared librar") != std::string::npos) return;  // not even loaded
    EXPECT_THAT(code, AnyOf(Eq(0), Eq(10), Eq(30), Eq(static_cast<int>(ExitCode::memory)))) << err;
    if (code == static_cast<int>(ExitCode::memory)) {
      EXPECT_EQ(err, "quadrille: error: the system has no more memory\n");
    } else {
      const auto result = nlohmann::json::parse(read("out"));
      num_stopped_ += result["stop_reason"] == "memory" ? 1 : 0;
      EXPECT_GE(result["lower_bound"], 0);
      EXPECT_EQ(err, "");
    }
  }

  /// With ten limits each, from one that lets the program start.
  void expect_proper_ends(const std::string& arguments) {
    int least = 8;
    while (run_within(least, "--help") != 0) ++least;
    for (const int more : {0, 1, 2, 4, 6, 9, 13, 18, 27, 40})
      expect_proper_end(least + more, arguments);
  }

  int num_stopped_ = 0;
};

TEST_F(MemoryTest, RunsOutOnGrids) {
  if (support::kAddressSanitizer)
    GTEST_SKIP() << "the sanitizer needs more address space than any limit leaves";
  ASSERT_EQ(run({"generate", "--kind", "empty", "--width", "60", "--height", "60", "--map-output",
                 path("m.map"), "--scen-output", path("m.scen"), "--agents", "500"})
                .code,
            0);
  const std::string instance = "solve --map " + path("m.map") + " --scen " + path("m.scen") +
                               " --agents 500 --cpu-limit 0.5";
  for (const char* system : {"dpll", "dpll-mdd", "smt-cbs", "mdd-sat"})
    expect_proper_ends(instance + " --system " + system);
  expect_proper_ends(instance + " --objective makespan --no-first-plan");
  expect_proper_ends(instance + " --threads 2");
  EXPECT_GT(num_stopped_, 20);
}

TEST_F(MemoryTest, RunsOutOnRoadmaps) {
  if (support::kAddressSanitizer)
    GTEST_SKIP() << "the sanitizer needs more address space than any limit leaves";
  ASSERT_EQ(run({"generate", "--kind", "roadmap", "--vertices", "300", "--width", "40", "--height",
                 "40", "--agents", "100", "--mixed", "--instance-output", path("d.json")})
                .code,
            0);
  const std::string instance = "solve --instance " + path("d.json") + " --cpu-limit 0.5";
  for (const char* system : {"dpll", "smt-cbs"})
    for (const char* objective : {"sum-of-costs", "makespan"})
      expect_proper_ends(instance + " --system " + system + " --objective " + objective);
  EXPECT_GT(num_stopped_, 10);
}

}  // namespace
}  // namespace quadrille::cli::test
