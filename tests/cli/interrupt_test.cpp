// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;

using InterruptTest = CliTest;

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

TEST_F(InterruptTest, AtRandomMomentsTheBoundIsKept) {
  std::mt19937 random(20261121);
  const char* systems[] = {"dpll", "dpll-mdd", "smt-cbs", "mdd-sat"};
  for (int round = 0; round < 12; ++round) {
    // Before the first few milliseconds the program is not loaded yet and simply dies.
    const int ms = 60 + static_cast<int>(random() % 940);
    const int signal = round % 2 == 0 ? SIGINT : SIGTERM;
    const char* objective = round % 3 == 0 ? "makespan" : "sum-of-costs";
    SCOPED_TRACE(std::string(systems[round % 4]) + " " + objective + " " + std::to_string(ms));
    Process process(folder_, hard("solve", {"--system", systems[round % 4], "--objective",
                                            objective, "--json", "-", "--quiet"}));
    sleep_ms(ms);
    process.signal(signal);
    const Finished finished = process.wait(2);
    EXPECT_EQ(finished.signal, 0);
    EXPECT_THAT(finished.code, testing::AnyOf(0, 10, 30)) << finished.err;
    ASSERT_TRUE(json::accept(finished.out)) << finished.out;
    const json result = json::parse(finished.out);
    EXPECT_TRUE(result["lower_bound"].is_number_integer());
    if (finished.code == 0) continue;  // it was faster
    EXPECT_EQ(result["stop_reason"], "interrupt");
    EXPECT_EQ(result["status"], finished.code == 10 ? "feasible" : "unknown");
  }
}

TEST_F(InterruptTest, TheLowerBoundIsNotForgotten) {
  Process process(folder_, hard("solve", {"--json", "-", "--quiet"}));
  sleep_ms(700);
  process.signal(SIGINT);
  const Finished finished = process.wait(2);
  EXPECT_GT(json::parse(finished.out)["lower_bound"], 0);
}

TEST_F(InterruptTest, NoTemporaryFilesStay) {
  const auto arguments = hard("solve", {"--json", path("r.json"), "--plan", path("p.json")});
  const auto before = files();
  Process process(folder_, arguments);
  sleep_ms(300);
  process.signal(SIGINT);
  process.signal(SIGINT);
  (void)process.wait(2);
  auto after = files();
  std::erase(after, "r.json");
  std::erase(after, "p.json");  // there may be a plan already
  EXPECT_EQ(after, before);
}

TEST_F(InterruptTest, OtherCommandsDieOfASignalAsUsual) {
  // A pipe without a writer: the program waits for its input.
  const std::string pipe = path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Process process(folder_, {"info", "--map", pipe});
  sleep_ms(100);
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(2).signal, SIGTERM);
}

TEST_F(InterruptTest, ASecondSignalKills) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // Handlers stand before the input is read, and reading goes on after the first signal.
  Process process(folder_, {"solve", "--map", pipe, "--scen", path("small.scen"), "--agents", "1"});
  sleep_ms(100);
  process.signal(SIGINT);
  sleep_ms(100);
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(2).signal, SIGTERM);
}

}  // namespace
}  // namespace quadrille::cli::test
