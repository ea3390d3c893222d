// SPDX-License-Identifier: MIT
// Limits and signals hold from the first byte on: while input is read, made and checked, too.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <thread>

#include "cli/process.hpp"
#include "support/sanitizer.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Words = std::vector<std::string>;

class LimitsTest : public CliTest {
 protected:
  /// A pipe without a writer: who reads it waits for ever.
  [[nodiscard]] std::string silent(const std::string& name) const {
    const std::string pipe = path(name);
    EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    return pipe;
  }

  /// Ways to wait for input that does not come, for commands that take an instance.
  [[nodiscard]] std::vector<Words> silent_instances() const {
    const std::string pipe = silent("pipe"), map = silent("pipe.map"), yaml = silent("pipe.yaml");
    return {{"--map", pipe, "--scen", path("small.scen"), "--agents", "2"},
            {"--map", path("small.map"), "--scen", pipe, "--agents", "2"},
            {"--instance", pipe},
            {"--instance", yaml},
            {"--roadmap", pipe, "--task", path("small.scen")},
            {"--roadmap", map, "--task", path("small.scen")},
            {"--roadmap", path("small.map"), "--task", pipe}};
  }

  /// So many cells in a row are passable, all others are not.
  std::string write_map(const std::string& name, std::size_t width, std::size_t height,
                        std::size_t passable_rows) {
    std::string text = "type octile\nheight " + std::to_string(height) + "\nwidth " +
                       std::to_string(width) + "\nmap\n";
    for (std::size_t row = 0; row < height; ++row)
      text += std::string(width, row < passable_rows ? '.' : '@') + "\n";
    return write(name, text);
  }

  /// A roadmap of side * side vertices with a disc on each of them.
  std::string write_discs(const std::string& name, int side) {
    std::string vertices, edges, agents;
    for (int v = 0; v < side * side; ++v) {
      const auto edge = [&](int w) {
        edges += std::string(edges.empty() ? "" : ",\n") + "[" + std::to_string(v) + ", " +
                 std::to_string(w) + "]";
      };
      vertices += std::string(v == 0 ? "" : ",\n") + "[" + std::to_string(v % side) + ", " +
                  std::to_string(v / side) + "]";
      if (v % side + 1 < side) edge(v + 1);
      if (v % side > 0) edge(v - 1);
      if (v + side < side * side) edge(v + side);
      if (v >= side) edge(v - side);
      agents += std::string(v == 0 ? "" : ",\n") + "{\"start\": " + std::to_string(v) +
                ", \"goal\": " + std::to_string((v + 5) % (side * side)) + ", \"radius\": 0.3}";
    }
    return write(
        name, "{\"quadrille\": \"instance\", \"version\": 1,\n\"roadmap\": {\"vertices\": [" +
                  vertices + "],\n\"edges\": [" + edges + "]},\n\"agents\": [" + agents + "]}\n");
  }
};

void expect_ended(const Finished& finished, const char* reason) {
  EXPECT_EQ(finished.signal, 0);
  EXPECT_EQ(finished.code, 30) << finished.err;
  ASSERT_TRUE(json::accept(finished.out)) << finished.out << finished.err;
  const json result = json::parse(finished.out);
  EXPECT_EQ(result["status"], "unknown");
  EXPECT_EQ(result["stop_reason"], reason);
  EXPECT_EQ(result["lower_bound"], 0);
  EXPECT_EQ(result["agents"], nullptr);
  EXPECT_EQ(result["explanation"],
            std::string("stopped while the input was read and checked: ") + reason);
}

TEST_F(LimitsTest, ASilentInputOfASearchEndsAtTheFirstSignal) {
  std::vector<Words> inputs = silent_instances();
  Words instance = small("solve");
  instance.erase(instance.begin());
  for (const char* plan : {"--initial-plan", "--known-plan"})
    inputs.push_back(instance + Words{plan, path("pipe")});
  int number = SIGINT;
  for (const char* command : {"solve", "explain"})
    for (const Words& input : inputs) {
      if (std::string(command) == "explain" && input.size() > 7) continue;  // takes no plans
      SCOPED_TRACE(command + testing::PrintToString(input));
      Process process(folder_, Words{command, "--json", "-"} + input);
      process.wait_until_caught(SIGTERM);
      number = number == SIGINT ? SIGTERM : SIGINT;
      process.signal(number);
      expect_ended(process.wait(2), "interrupt");
    }
}

TEST_F(LimitsTest, WithoutOutputsItIsToldAsAnyResult) {
  Process process(folder_, {"solve", "--plan", path("p.json"), "--instance", silent("pipe")});
  process.wait_until_caught(SIGTERM);
  process.signal(SIGINT);
  const Finished finished = process.wait(2);
  EXPECT_EQ(finished.code, 30);
  EXPECT_THAT(finished.out, HasSubstr("result     unknown (stopped: interrupt)\n"));
  EXPECT_FALSE(exists("p.json"));
}

TEST_F(LimitsTest, OtherCommandsDieAtTheFirstSignal) {
  std::vector<Words> commands;
  for (const Words& input : silent_instances()) {
    for (const char* command : {"verify", "view", "execute-check", "simulate"})
      commands.push_back(Words{command} + input + Words{write("plan.json", "{}")});
    commands.push_back(Words{"info"} + input);
    commands.push_back(Words{"convert", "--to", "json"} + input);
  }
  const std::string pipe = path("pipe");
  commands.push_back(small("verify", {pipe}));
  commands.push_back({"export", "--to", "csv", "--instance", pipe, path("plan.json")});
  commands.push_back({"generate", "--map", pipe, "--agents", "2", "--scen-output", path("s")});
  for (const char* action : {"list", "run"}) commands.push_back({"campaign", action, pipe});
  // All at once: each one waits.
  std::vector<std::unique_ptr<Process>> processes;
  for (const Words& command : commands)
    processes.push_back(std::make_unique<Process>(folder_, command));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  for (const auto& process : processes) process->signal(SIGTERM);
  for (std::size_t k = 0; k < processes.size(); ++k)
    EXPECT_EQ(processes[k]->wait(2).signal, SIGTERM) << testing::PrintToString(commands[k]);
}

TEST_F(LimitsTest, ASilentInputEndsWithTheTime) {
  const std::vector<Words> inputs = silent_instances();
  // Each takes the second that it may wait.
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
    SCOPED_TRACE(testing::PrintToString(inputs[k]));
    const char* command = k == 2 ? "explain" : "solve";
    const Words words = Words{command, "--json", "-", "--time-limit", "0.1"} + inputs[k];
    expect_ended(Process(folder_, words).wait(2), "wall-time");
  }
}

TEST_F(LimitsTest, CpuTimeAndMemoryHoldWhileALargeFileIsRead) {
  const Words solve = {
      "solve",    "--quiet",
      "--json",   "-",
      "--map",    write_map("large.map", 8192, 8192, 1),
      "--scen",   write("large.scen", "version 1\n0\tlarge.map\t8192\t8192\t0\t0\t9\t0\t9\n"),
      "--agents", "1"};
  expect_ended(Process(folder_, solve + Words{"--cpu-limit", "0.02"}).wait(1), "cpu-time");
  expect_ended(Process(folder_, solve + Words{"--time-limit", "0.02"}).wait(1), "wall-time");
  expect_ended(Process(folder_, solve + Words{"--memory-limit", "5"}).wait(1), "memory");
}

// What was used while the input was read is no longer there for the search.
TEST_F(LimitsTest, ReadingAndSearchingShareTheLimit) {
  // With a sanitizer reading alone takes more than a second.
  constexpr int kLimit = support::kAddressSanitizer ? 3 : 1;
  const Words solve = {"solve", "--quiet",    "--json",
                       "-",     "--instance", write_discs("discs.json", 140)};
  const Finished finished =
      Process(folder_, solve + Words{"--cpu-limit", std::to_string(kLimit)}).wait(kLimit + 1);
  EXPECT_EQ(finished.code, 30) << finished.err;
  const json result = json::parse(finished.out);
  EXPECT_EQ(result["stop_reason"], "cpu-time");
  EXPECT_EQ(result["agents"], 140 * 140);
  // Reading takes a third of the limit or more; what comes after it some hundredths of a second.
  EXPECT_LT(result["statistics"]["cpu_s"], 1.2 * kLimit);
  EXPECT_GT(result["lower_bound"], 0);
}

TEST_F(LimitsTest, NoPlanIsLostToASignalAfterTheSearch) {
  const std::string pipe = silent("out");
  const int end = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(end, 0);
  std::string filled;
  while (::write(end, " ", 1) == 1) filled += ' ';
  Process process(folder_, small("solve", {"--quiet", "--plan", pipe}));
  process.wait_until_caught(SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // it writes, and cannot
  process.signal(SIGINT);
  process.wait_until_received(SIGINT);
  std::string text;
  std::thread reader([&] {
    char c = 0;
    while (text.size() <= filled.size() || std::count(text.begin(), text.end(), '{') == 0 ||
           std::count(text.begin(), text.end(), '}') < 1)
      if (::read(end, &c, 1) == 1) text += c;
  });
  const Finished finished = process.wait(2);
  reader.join();
  ::close(end);
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_TRUE(json::accept(text)) << text.substr(filled.size());
}

TEST_F(LimitsTest, MapsThatAreTooLargeAreRefusedByName) {
  // 2^23 vertices can be solved, by the MDD systems 2^21.
  const std::string large = write_map("large.map", 4096, 2049, 2049);
  const std::string scen = write("s.scen", "version 1\n0\tlarge.map\t4096\t2049\t0\t0\t9\t0\t9\n");
  for (const char* command : {"solve", "explain"})
    for (const Words& input : {Words{"--map", large, "--scen", scen, "--agents", "1"},
                               Words{"--roadmap", large, "--task", scen}}) {
      const Finished finished = run(Words{command} + input);
      EXPECT_EQ(finished.code, 65);
      EXPECT_EQ(finished.err, "quadrille: " + large +
                                  ": the map has 8392704 passable cells, more than 8388608, which "
                                  "are the most that can be solved: take a coarser map, or a part "
                                  "of it\n");
    }
  const Words less = {"--quiet", "--map",       write_map("large.map", 4096, 2049, 600),
                      "--scen",  scen,          "--agents",
                      "1",       "--time-limit"};
  const Finished blocked = run(Words{"solve"} + less + Words{"0"});
  EXPECT_THAT(blocked.code, testing::AnyOf(0, 10, 30)) << blocked.err;
  const Finished mdd = run(Words{"solve", "--system", "smt-cbs"} + less + Words{"60"});
  EXPECT_EQ(mdd.code, 65);
  EXPECT_THAT(mdd.err, HasSubstr("the most for the system smt-cbs; dpll takes more"));
}

TEST_F(LimitsTest, SoAreInstances) {
  std::string rows;
  for (int y = 0; y < 2049; ++y) rows += (y == 0 ? "\"" : ",\n\"") + std::string(4096, '.') + "\"";
  write("grid.json",
        "{\"quadrille\": \"instance\", \"version\": 1, \"grid\": {\"width\": 4096, "
        "\"height\": 2049, \"rows\": [" +
            rows + "]}, \"agents\": []}");
  const Finished grid = run({"solve", "--instance", path("grid.json")});
  EXPECT_EQ(grid.code, 65);
  EXPECT_THAT(grid.err, HasSubstr(path("grid.json") +
                                  ":1: /grid: there are 8392704 vertices, more than 8388608"));
  EXPECT_EQ(run({"info", "--instance", path("grid.json")}).code, 0);
  // What a file only states is refused everywhere.
  write("graph.json",
        "{\"quadrille\": \"instance\", \"version\": 1,\n\"graph\": {\"vertices\": "
        "8388609, \"edges\": []}, \"agents\": []}");
  write("map.yaml", "map:\n  dimensions: [4096, 2049]\nagents: []\n");
  for (const auto& [name, place] :
       {std::pair("graph.json", ":2: /graph/vertices"), std::pair("map.yaml", ":2:")})
    for (const char* command : {"solve", "info"}) {
      const Finished finished = run({command, "--instance", path(name)});
      EXPECT_EQ(finished.code, 65);
      EXPECT_THAT(finished.err, HasSubstr(path(name) + place));
      EXPECT_THAT(finished.err, HasSubstr("8388608"));
    }
}

TEST_F(LimitsTest, TheLargestMapIsRefusedBeforeItTakesMemory) {
  if (support::kAddressSanitizer)
    GTEST_SKIP() << "the sanitizer needs more address space than any limit leaves";
  const std::string large = write_map("large.map", 8192, 8192, 8192);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  const rlimit gigabyte{1'000'000'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &gigabyte), 0);
  const Finished finished =
      run({"solve", "--map", large, "--scen", path("small.scen"), "--agents", "1"});
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(finished.code, 65);
  EXPECT_THAT(finished.err, HasSubstr(large + ": the map has 67108864 passable cells"));
}

}  // namespace
}  // namespace quadrille::cli::test
