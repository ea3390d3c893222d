// SPDX-License-Identifier: MIT
//
// What beginners get wrong in a file with robots on a roadmap: file, line, what it is called there,
// and the number that they wrote. The table for Python is tests/python/test_mistakes.py.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

constexpr const char* kGood = R"({
  "quadrille": "instance",
  "version": 1,
  "resolution": 0.001,
  "roadmap": {
    "vertices": [[0, 0], [4, 0], [8, 0], [8, 9], [4, 5]],
    "edges": [[0, 1], [1, 0], [1, 2], [2, 1], [1, 4], [4, 1]]
  },
  "agents": [
    {"start": 0, "goal": 2, "radius": 0.3, "speed": 1},
    {"start": 2, "goal": 0, "radius": 0.2, "deadline": 99, "at_goal": "leave", "release": 0},
    {"start": 3, "goal": 3, "radius": 0.2}
  ]
}
)";

class MistakesTest : public CliTest {
 protected:
  std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return write("bad.json", text.replace(text.find(from), from.size(), to));
  }
  void expect(int code, const std::string& file, const std::string& message) {
    const Finished finished = run({"solve", "--instance", file, "--quiet", "--json", "-"});
    SCOPED_TRACE(finished.err + finished.out);
    EXPECT_EQ(finished.code, code);
    if (code == 20)
      EXPECT_EQ(nlohmann::json::parse(finished.out).at("explanation"), message);
    else
      EXPECT_EQ(finished.err, "quadrille: " + message + "\n");
  }
};

TEST_F(MistakesTest, AreRefusedWithPlaceNameAndNumber) {
  const std::string good = write("good.json", kGood);
  EXPECT_EQ(run({"solve", "--instance", good, "--quiet"}).code, 0);
  const struct {
    const char *from, *to, *message;
  } cases[] = {
      {"\"start\": 0", "\"start\": 7", "10: /agents/0/start: there is no vertex 7 among 5"},
      {"\"radius\": 0.3", "\"radius\": -0.3",
       "10: /agents/0/radius: the radius is less than one length unit, or too large: -0.3"},
      {"\"radius\": 0.3", "\"radius\": 0.00025",
       "10: /agents/0/radius: the radius is less than one length unit, or too large: 0.00025"},
      {"\"radius\": 0.3, ", "", "10: /agents/0: one of the keys 'radius' and 'polygon' is missing"},
      {"\"radius\": 0.3", "\"polygon\": [[0, 0], [1, 0], [2, 0]]",
       "10: /agents/0/polygon: polygon: three consecutive corners are on a line, in whole length "
       "units"},
      {"\"speed\": 1", "\"speed\": 0",
       "10: /agents/0/speed: the speed is not 0.000001 .. 1000000 length units per tick: 0"},
      {"\"speed\": 1", "\"speed\": -1.5",
       "10: /agents/0/speed: the speed is not 0.000001 .. 1000000 length units per tick: -1.5"},
      {"\"speed\": 1", "\"speed\": \"fast\"",
       "10: /agents/0/speed: expected a number, found a string"},
      {"\"speed\": 1", "\"sped\": 1", "10: /agents/0/sped: this key is not known here"},
      {"\"deadline\": 99", "\"deadline\": -2",
       "11: /agents/1/deadline: the time is negative, or too late: -2"},
      {"\"release\": 0", "\"release\": -2.5",
       "11: /agents/1/release: the time is negative, or too late: -2.5"},
      {"\"leave\"", "\"vanish\"",
       "11: /agents/1/at_goal: expected 'stay' or 'leave', found 'vanish'"},
      {"[1, 0]", "[0, 0]", "7: /roadmap/edges/1: the edge is a loop"},
      {"[1, 0]", "[1, 9]", "7: /roadmap/edges/1/1: there is no vertex 9 among 5"},
      {"[4, 0]", "[4]", "6: /roadmap/vertices/1: expected 2 coordinates, found 1"},
      {"\"resolution\": 0.001", "\"resolution\": 0", "4: /resolution: a resolution is positive"},
      {"\"instance\"", "\"plan\"", "2: /quadrille: expected 'instance', found 'plan'"},
  };
  for (const auto& c : cases) {
    const std::string file = with(c.from, c.to);
    expect(65, file, file + ":" + c.message);
  }
  const std::string none = path("none.json");
  expect(65, none, none + ": cannot be opened: No such file or directory");
}

TEST_F(MistakesTest, OrGiveNoPlan) {
  const struct {
    const char *from, *to, *message;
  } cases[] = {
      {"\"goal\": 0", "\"goal\": 3", "11: agent 1 cannot get from vertex 2 to vertex 3"},
      {"\"deadline\": 99", "\"deadline\": 7.5",
       "11: agent 1 cannot arrive before 8, and its deadline is 7.5"},
      {"\"start\": 2", "\"start\": 0",
       "11: the starts of agent 0 at vertex 0 and agent 1 at vertex 0 overlap"},
      {"\"start\": 3, \"goal\": 3", "\"start\": 3, \"goal\": 2",
       "12: the goals of agent 0 at vertex 2 and agent 2 at vertex 2 overlap"},
  };
  for (const auto& c : cases) {
    const std::string file = with(c.from, c.to);
    expect(20, file, file + ":" + c.message);
  }
}

}  // namespace
}  // namespace quadrille::cli::test
