// SPDX-License-Identifier: MIT
//
// Each key of the rules, wrong in each way: one message, with the place in the file and its path.
#include <gmock/gmock.h>

#include <sstream>
#include <string>

#include "quadrille/discrete/instance_json.hpp"

namespace quadrille::discrete {
namespace {

using testing::HasSubstr;

/// A line of four vertices. `rest`: members of the file after the graph, `agent`: of the agent.
std::string line_file(const std::string& rest, const std::string& agent = "",
                      const std::string& graph = "") {
  return R"({"quadrille": "instance", "version": 1,
"graph": {"vertices": 4, "edges": [[0, 1], [1, 2], [2, 3]])" +
         graph + "}" + rest + ",\n" + R"("agents": [{"start": 0, "goal": 3)" + agent + "}]}";
}
std::string grid_file(const std::string& rest, const std::string& agent = "",
                      const std::string& grid = "") {
  return R"({"quadrille": "instance", "version": 1,
"grid": {"width": 3, "height": 2, "rows": ["...", ".@."])" +
         grid + "}" + rest + ",\n" + R"("agents": [{"start": [0, 0], "goal": [2, 1])" + agent +
         "}]}";
}

struct Mistake {
  std::string file;
  std::string path;  ///< In the message.
  std::string why;
  ErrorCode code;
  long line = 3;
};

TEST(RulesJson, MistakesAreNamed) {
  using enum ErrorCode;
  const auto rest = [](const std::string& key, const std::string& value) {
    return line_file(", \"" + key + "\": " + value);
  };
  const auto own = [](const std::string& key, const std::string& value) {
    return line_file("", ", \"" + key + "\": " + value);
  };
  const auto obstacle = [&](const std::string& members) {
    return rest("obstacles", "[{" + members + "}]");
  };
  const auto path = [&](const std::string& stops) { return obstacle("\"path\": [" + stops + "]"); };
  const std::string o = "/obstacles/0", stops = o + "/path";
  const Mistake mistakes[] = {
      // Of all agents.
      {rest("robust", "-1"), "/robust", "-1", out_of_range, 2},
      {rest("robust", "1.5"), "/robust", "", syntax, 2},
      {rest("robust", "\"1\""), "/robust", "", syntax, 2},
      {rest("robust", "null"), "/robust", "", syntax, 2},
      {rest("robust", "1048576"), "/robust", "1048576", out_of_range, 2},
      {rest("robust", "1e99"), "/robust", "", syntax, 2},
      {rest("robust", "1, \"robust\": 1"), "robust", "twice", syntax, 2},
      {rest("follow", "false"), "/follow", "not known", syntax, 2},
      // Agents.
      {own("release", "-1"), "/agents/0/release", "-1", out_of_range},
      {own("release", "2.5"), "/agents/0/release", "", syntax},
      {own("release", "[1]"), "/agents/0/release", "", syntax},
      {own("release", "1048576"), "/agents/0/release", "1048576", out_of_range},
      {own("deadline", "-1"), "/agents/0/deadline", "-1", out_of_range},
      {own("deadline", "true"), "/agents/0/deadline", "", syntax},
      {own("deadline", "99999999999999999999"), "/agents/0/deadline", "", syntax},
      {own("deadline", "1048576"), "/agents/0/deadline", "1048576", out_of_range},
      {own("at_goal", "\"go\""), "/agents/0/at_goal", "'go'", syntax},
      {own("at_goal", "true"), "/agents/0/at_goal", "", syntax},
      {own("at_start", "\"stay\""), "/agents/0/at_start", "not known", syntax},
      {own("waypoints", "1"), "/agents/0/waypoints", "", syntax},
      {own("waypoints", "[4]"), "/agents/0/waypoints/0", "4", invalid_instance},
      {own("waypoints", "[1, -1]"), "/agents/0/waypoints/1", "-1", invalid_instance},
      {own("waypoints", "[[1, 0]]"), "/agents/0/waypoints/0", "", syntax},
      {own("waypoints", "[\"1\"]"), "/agents/0/waypoints/0", "", syntax},
      {grid_file("", ", \"waypoints\": [[1, 1]]"), "/agents/0/waypoints/0", "", invalid_instance},
      {grid_file("", ", \"waypoints\": [[3, 0]]"), "/agents/0/waypoints/0", "", invalid_instance},
      {grid_file("", ", \"waypoints\": [1]"), "/agents/0/waypoints/0", "", syntax},
      // Edges that lead one way.
      {line_file("", "", ", \"directed\": 1"), "/graph/directed", "", syntax, 2},
      {line_file("", "", ", \"one_way\": [[0, 4]]"), "/graph/one_way/0/1", "4", invalid_instance,
       2},
      {line_file("", "", ", \"one_way\": [[0, 2]]"), "/graph", "edge", invalid_instance, 2},
      {line_file("", "", ", \"one_way\": [[0, 1], [1, 0]]"), "/graph", "", invalid_instance, 2},
      {line_file("", "", ", \"one_way\": [0, 1]"), "/graph/one_way/0", "", syntax, 2},
      {grid_file("", "", ", \"one_way\": [[[0, 0], [1, 1]]]"), "/grid/one_way/0/1", "",
       invalid_instance, 2},
      {grid_file("", "", ", \"one_way\": [[[0, 0], [2, 0]]]"), "/grid", "edge", invalid_instance,
       2},
      // Obstacles.
      {rest("obstacles", "{}"), "/obstacles", "", syntax, 2},
      {rest("obstacles", "[1]"), o, "", syntax, 2},
      {obstacle("\"first\": 1"), o, "'vertex', 'edge' and 'path'", syntax, 2},
      {obstacle("\"vertex\": 1, \"edge\": [0, 1]"), o, "one of the keys", syntax, 2},
      {obstacle("\"vertex\": 4"), o + "/vertex", "4", invalid_instance, 2},
      {obstacle("\"vertex\": 1, \"first\": -1"), o + "/first", "-1", out_of_range, 2},
      {obstacle("\"vertex\": 1, \"first\": 2, \"last\": 1"), o, "ends before", invalid_instance, 2},
      {obstacle("\"vertex\": 1, \"last\": 1048576"), o + "/last", "1048576", out_of_range, 2},
      {obstacle("\"vertex\": 1, \"last\": \"never\""), o + "/last", "", syntax, 2},
      {obstacle("\"vertex\": 1, \"at_end\": \"stay\""), o + "/at_end", "only a 'path'", syntax, 2},
      {obstacle("\"edge\": [0, 2]"), o + "/edge", "no such edge", invalid_instance, 2},
      {obstacle("\"edge\": [0, 1, 2]"), o + "/edge", "", syntax, 2},
      {obstacle("\"edge\": [0, 9]"), o + "/edge/1", "9", invalid_instance, 2},
      {obstacle("\"speed\": 1, \"vertex\": 1"), o + "/speed", "not known", syntax, 2},
      {path(""), stops, "at least one stop", invalid_instance, 2},
      {path("1"), stops + "/0", "", syntax, 2},
      {path("{\"vertex\": 1}"), stops + "/0", "'arrive'", syntax, 2},
      {path("{\"vertex\": 1, \"arrive\": 2, \"depart\": 1}"), stops + "/0", "before it arrives",
       invalid_instance, 2},
      {path("{\"vertex\": 1, \"arrive\": 2}, {\"vertex\": 2, \"arrive\": 4}"), stops + "/1",
       "at timestep 2", invalid_instance, 2},
      {path("{\"vertex\": 1, \"arrive\": 2}, {\"vertex\": 3, \"arrive\": 3}"), stops + "/1",
       "no edge", invalid_instance, 2},
      {obstacle("\"path\": [{\"vertex\": 1, \"arrive\": 2}], \"first\": 1"), o,
       "times of their own", syntax, 2},
      {obstacle("\"path\": [{\"vertex\": 1, \"arrive\": 2}], \"at_end\": \"go\""), o + "/at_end",
       "'go'", syntax, 2},
  };
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.file);
    std::istringstream in(mistake.file);
    const auto read = read_instance_json(in, "f.json");
    ASSERT_FALSE(read);
    const Error& error = read.error();
    EXPECT_EQ(error.code, mistake.code) << error.to_string();
    EXPECT_EQ(error.where.file, "f.json");
    EXPECT_EQ(error.where.line, mistake.line) << error.to_string();
    EXPECT_THAT(error.message, HasSubstr(mistake.path));
    EXPECT_THAT(error.message, HasSubstr(mistake.why));
  }
}

TEST(RulesJson, GoodOnesAreRead) {
  for (const std::string& file :
       {line_file(", \"robust\": 1048575"), line_file("", ", \"release\": 1048575"),
        line_file("", ", \"at_goal\": \"leave\", \"waypoints\": [0, 1, 1, 3]"),
        line_file(", \"obstacles\": []"), line_file("", "", ", \"one_way\": [[1, 0]]"),
        grid_file("", ", \"waypoints\": [[1, 0]]", ", \"one_way\": [[[0, 0], [1, 0]]]")}) {
    std::istringstream in(file);
    const auto read = read_instance_json(in, "f.json");
    EXPECT_TRUE(read) << file << "\n" << read.error().to_string();
  }
}

}  // namespace
}  // namespace quadrille::discrete
