// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/process.hpp"

namespace quadrille::cli::test {

/// With small roadmaps in the folder.
class RoadmapCliTest : public CliTest {
 protected:
  RoadmapCliTest() {
    copy("discs.json", "discs.json");
    write("map.xml",
          "<graphml>\n<key id=\"c\" for=\"node\" attr.name=\"coords\"/>\n"
          "<graph edgedefault=\"directed\">\n"
          "<node id=\"n0\"><data key=\"c\">0,0</data></node>\n"
          "<node id=\"n1\"><data key=\"c\">2,0</data></node>\n"
          "<node id=\"n2\"><data key=\"c\">1,-1</data></node>\n"
          "<node id=\"n3\"><data key=\"c\">1,1</data></node>\n"
          "<edge source=\"n0\" target=\"n1\"/>\n"
          "<edge source=\"n2\" target=\"n3\"/>\n"
          "</graph>\n</graphml>\n");
    write("task.xml",
          "<root>\n<agent start_id=\"0\" goal_id=\"1\"/>\n<agent start_id=\"2\" goal_id=\"3\"/>\n"
          "<agent start_id=\"0\" goal_id=\"1\"/>\n</root>\n");
  }

  void copy(const std::string& from, const std::string& to) const {
    std::ifstream in(std::string(QUADRILLE_SOURCE_DIR "/tests/data/roadmaps/") + from);
    std::ostringstream text;
    text << in.rdbuf();
    ASSERT_FALSE(text.str().empty());
    write(to, text.str());
  }

  /// Two discs of different radii and speeds and a siding.
  [[nodiscard]] std::vector<std::string> discs(const std::string& command,
                                               const std::vector<std::string>& more = {}) const {
    return std::vector<std::string>{command, "--instance", path("discs.json")} + more;
  }
  /// Two crossing roads, radius 0.3.
  [[nodiscard]] std::vector<std::string> xml(const std::string& command,
                                             const std::vector<std::string>& more = {}) const {
    return std::vector<std::string>{command,  "--roadmap",      path("map.xml"),
                                    "--task", path("task.xml"), "--agents",
                                    "2",      "--radius",       "0.3"} +
           more;
  }
  /// An instance that takes minutes.
  [[nodiscard]] std::vector<std::string> crowd(const std::string& command,
                                               const std::vector<std::string>& more = {}) const {
    if (!exists("crowd.json")) {
      const Finished made =
          run({"generate", "--kind", "roadmap", "--vertices", "45", "--agents", "44", "--width",
               "9", "--height", "9", "--seed", "1", "--instance-output", path("crowd.json")});
      EXPECT_EQ(made.code, 0) << made.err;
    }
    return std::vector<std::string>{command, "--instance", path("crowd.json")} + more;
  }
};

}  // namespace quadrille::cli::test
