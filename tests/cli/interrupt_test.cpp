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

class InterruptShard : public CliTest, public testing::WithParamInterface<int> {};

TEST_P(InterruptShard, AtRandomMomentsTheBoundIsKept) {
  std::mt19937 random(20261121 + static_cast<unsigned>(GetParam()));
  const char* systems[] = {"dpll", "dpll-mdd", "smt-cbs", "mdd-sat"};
  for (int round = 0; round < 10; ++round) {
    const int ms = static_cast<int>(random() % 600);
    const int signal = round % 2 == 0 ? SIGINT : SIGTERM;
    const char* objective = round % 3 == 0 ? "makespan" : "sum-of-costs";
    SCOPED_TRACE(std::string(systems[round % 4]) + " " + objective + " " + std::to_string(ms));
    Process process(
        folder_, hard("solve", {"--system", systems[round % 4], "--objective", objective, "--json",
                                path("result.json"), "--plan", path("plan.json"), "--quiet"}));
    process.wait_until_caught(signal);
    sleep_ms(ms);
    process.signal(signal);
    const Finished finished = process.wait(2);
    EXPECT_EQ(finished.signal, 0);
    EXPECT_THAT(finished.code, testing::AnyOf(0, 10, 30)) << finished.err;
    const std::string text = read("result.json");
    ASSERT_TRUE(json::accept(text)) << text;
    const json result = json::parse(text);
    EXPECT_TRUE(result["lower_bound"].is_number_integer());
    if (finished.code == 0) continue;  // it was faster
    EXPECT_EQ(result["stop_reason"], "interrupt");
    EXPECT_EQ(result["status"], finished.code == 10 ? "feasible" : "unknown");
    EXPECT_EQ(exists("plan.json"), finished.code == 10);
    if (finished.code != 10) continue;
    EXPECT_LT(result["lower_bound"], result["cost"]);
    EXPECT_EQ(run(hard("verify", {path("plan.json")})).code, 0);
    std::filesystem::remove(path("plan.json"));
  }
}

INSTANTIATE_TEST_SUITE_P(FiftyMoments, InterruptShard, testing::Range(0, 5));

TEST_F(InterruptTest, TheLowerBoundIsNotForgotten) {
  Process process(folder_, hard("solve", {"--json", "-", "--quiet"}));
  process.wait_until_caught(SIGINT);
  sleep_ms(700);
  process.signal(SIGINT);
  const Finished finished = process.wait(2);
  EXPECT_GT(json::parse(finished.out)["lower_bound"], 0);
}

TEST_F(InterruptTest, WhoIsKilledLeavesThePlanThatItHad) {
  Process process(folder_,
                  hard("solve", {"--plan", path("p.json"), "--plan-every", "0", "--quiet"}));
  for (int ms = 0; ms < 20'000 && !exists("p.json"); ms += 10) sleep_ms(10);
  for (int look = 0; look < 5; ++look) {  // while it is replaced
    EXPECT_EQ(run(hard("verify", {path("p.json")})).code, 0);
    sleep_ms(20);
  }
  process.signal(SIGKILL);
  EXPECT_EQ(process.wait(2).signal, SIGKILL);
  EXPECT_EQ(run(hard("verify", {path("p.json")})).code, 0);
}

TEST_F(InterruptTest, NoTemporaryFilesStay) {
  const auto arguments = hard("solve", {"--json", path("r.json"), "--plan", path("p.json")});
  const auto before = files();
  Process process(folder_, arguments);
  process.wait_until_caught(SIGINT);
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
  // Nobody takes the plan, and writing goes on after the first signal.
  Process process(folder_, small("solve", {"--quiet", "--plan", pipe}));
  process.wait_until_caught(SIGTERM);
  sleep_ms(300);
  process.signal(SIGINT);
  process.wait_until_received(SIGINT);
  process.signal(SIGTERM);
  EXPECT_EQ(process.wait(2).signal, SIGTERM);
}

}  // namespace
}  // namespace quadrille::cli::test
