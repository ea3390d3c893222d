// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using OutputTest = CliTest;

TEST_F(OutputTest, AFullDeviceIs74ForEveryOutput) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  const std::vector<std::string> cases[] = {
      small("solve", {"--json", "/dev/full"}),
      small("solve", {"--plan", "/dev/full"}),
      small("solve", {"--plan", "/dev/full", "--json", "/dev/full", "--quiet"}),
      {"generate", "--kind", "empty", "--map-output", "/dev/full"},
      {"generate", "--map", path("small.map"), "--agents", "2", "--scen-output", "/dev/full"},
      {"convert", "--map", path("small.map"), "--to", "cbsh2", "--output", "/dev/full",
       path("p.json")},
      small("convert", {"--to", "json", "--output", "/dev/full"})};
  for (const auto& arguments : cases) {
    const Finished finished = run(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments));
    EXPECT_EQ(finished.code, 74);
    EXPECT_THAT(finished.err, HasSubstr("quadrille: /dev/full: cannot write: No space left"));
  }
}

TEST_F(OutputTest, AFullStdoutIs74ForEveryCommand) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  const std::vector<std::string> cases[] = {small("solve"),
                                            small("solve", {"--json", "-"}),
                                            small("solve", {"--plan", "-"}),
                                            small("verify", {path("p.json")}),
                                            small("info"),
                                            {"generate", "--kind", "empty"},
                                            small("convert", {"--to", "json"}),
                                            {"--help"},
                                            {"--version"},
                                            {"solve", "--help"}};
  for (const char* out : {"/dev/full", "closed"})
    for (const auto& arguments : cases) {
      SCOPED_TRACE(testing::PrintToString(arguments) + out);
      const Finished finished = run(arguments, out);
      EXPECT_EQ(finished.code, 74);
      EXPECT_THAT(finished.err, HasSubstr("quadrille: standard output: cannot write"));
    }
}

TEST_F(OutputTest, AResultThatCannotBeWrittenIsPrintedInstead) {
  const Finished lost = run(small("solve", {"--quiet", "--plan", "/dev/full"}));
  EXPECT_EQ(lost.code, 74);
  EXPECT_THAT(lost.err, HasSubstr("\"plan\": ["));
  const Finished piped = run(small("solve", {"--json", "-"}), "/dev/full");
  EXPECT_THAT(piped.err, HasSubstr("\"status\": \"optimal\""));
  const Finished told = run(small("solve"), "/dev/full");
  EXPECT_THAT(told.err, HasSubstr("result     optimal"));
  // One good output is enough.
  const Finished saved =
      run(small("solve", {"--quiet", "--plan", "/dev/full", "--json", path("r.json")}));
  EXPECT_EQ(saved.code, 74);
  EXPECT_THAT(saved.err, Not(HasSubstr("\"plan\"")));
  EXPECT_EQ(json::parse(read("r.json"))["status"], "optimal");
}

TEST_F(OutputTest, AnUnwritablePlaceIsFoundBeforeTheSearch) {
  for (const char* option : {"--json", "--plan"})
    for (const std::string& place :
         {path("missing/x"), folder_.string(), path("small.map/x"), std::string("/proc/x")}) {
      SCOPED_TRACE(std::string(option) + " " + place);
      Process process(folder_, hard("solve", {option, place, "--time-limit", "50"}));
      const Finished finished = process.wait(5);
      EXPECT_EQ(finished.code, 74);
      EXPECT_THAT(finished.err, HasSubstr("quadrille: " + place + ": cannot write: "));
      EXPECT_EQ(finished.out, "");
    }
}

TEST_F(OutputTest, FilesAreReplacedWholeAndKeepTheirModeAndLinks) {
  write("r.json", std::string(100000, 'x'));
  ASSERT_EQ(::chmod(path("r.json").c_str(), 0640), 0);
  std::filesystem::create_symlink("r.json", path("link"));
  ASSERT_EQ(run(small("solve", {"--quiet", "--json", path("link")})).code, 0);
  EXPECT_TRUE(json::accept(read("r.json")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  struct stat status {};
  ASSERT_EQ(::stat(path("r.json").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
  EXPECT_EQ(files(), (std::vector<std::string>{"corridor.map", "corridor.scen", "link", "r.json",
                                               "small.map", "small.scen"}));
}

TEST_F(OutputTest, WithoutAPlanAnOldPlanFileStays) {
  write("p.json", "old");
  const Finished finished = run(corridor("solve", {"--plan", path("p.json")}));
  EXPECT_EQ(finished.code, 20);
  EXPECT_EQ(read("p.json"), "old");
  EXPECT_THAT(finished.out, HasSubstr("p.json is not written"));
}

TEST_F(OutputTest, TwoOutputsToOneFileAreRefused) {
  // Names that lead to one file: `file` exists in the second round, and not in the first.
  std::filesystem::create_symlink("file", path("link"));
  std::filesystem::create_symlink("link", path("link-to-link"));
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("../file", path("folder/link"));
  std::filesystem::create_directory_symlink("folder", path("alias"));
  std::vector<std::string> names = {"file",         "./file",      "folder/../file", "link",
                                    "link-to-link", "folder/link", "alias/link"};
  for (const bool exists : {false, true}) {
    if (exists) {
      write("file", "old");
      std::filesystem::create_hard_link(path("file"), path("hard"));
      names.push_back("hard");
    }
    for (const std::string& a : names)
      for (const std::string& b : names) {
        SCOPED_TRACE(a + " " + b + (exists ? " exists" : ""));
        const Finished solved = run(small("solve", {"--plan", path(a), "--json", path(b)}));
        EXPECT_EQ(solved.code, 64);
        EXPECT_THAT(solved.err, HasSubstr("--plan and --json name the same output"));
        const Finished generated = run({"generate", "--kind", "empty", "--agents", "2",
                                        "--map-output", path(a), "--scen-output", path(b)});
        EXPECT_EQ(generated.code, 64);
        EXPECT_THAT(generated.err, HasSubstr("--map-output and --scen-output name the same"));
      }
  }
  EXPECT_EQ(read("file"), "old");
  EXPECT_EQ(run(small("solve", {"--plan", "-", "--json", "-"})).code, 64);
  // Standard output is a file like others.
  EXPECT_EQ(run(small("solve", {"--plan", "-", "--json", path("file")}), path("file")).code, 64);
}

TEST_F(OutputTest, AnInputIsNeverOverwritten) {
  ASSERT_EQ(run(small("solve", {"--quiet", "--plan", path("p.json")})).code, 0);
  ASSERT_EQ(run(small("convert", {"--to", "json", "--output", path("i.json")})).code, 0);
  const std::string map = path("small.map");
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"convert", "--map", map, "--to", "cbsh2", path("p.json"), "--output"}, "p.json"},
      {{"convert", "--map", map, "--to", "cbsh2", path("p.json"), "--output"}, "small.map"},
      {small("convert", {"--to", "json", "--output"}), "small.scen"},
      {{"convert", "--instance", path("i.json"), "--to", "yaml", "--output"}, "i.json"},
      {{"generate", "--map", map, "--agents", "2", "--scen-output"}, "small.map"},
      {small("solve", {"--json"}), "small.map"}};
  for (const auto& [arguments, input] : cases) {
    const std::string before = read(input);
    std::filesystem::remove(path("link"));
    std::filesystem::remove(path("hard"));
    std::filesystem::create_symlink(input, path("link"));
    std::filesystem::create_hard_link(path(input), path("hard"));
    for (const std::string& output : {input, std::string("link"), std::string("hard")}) {
      SCOPED_TRACE(testing::PrintToString(arguments) + output);
      const Finished finished = run(arguments + std::vector<std::string>{path(output)});
      EXPECT_EQ(finished.code, 64);
      EXPECT_THAT(finished.err, HasSubstr(path(output) + " is an input of this run"));
      EXPECT_EQ(read(input), before);
    }
  }
}

TEST_F(OutputTest, ALinkToNothingIsWrittenThrough) {
  std::filesystem::create_symlink("target.json", path("link"));
  ASSERT_EQ(run(small("solve", {"--quiet", "--json", path("link")})).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_TRUE(json::accept(read("target.json")));
}

TEST_F(OutputTest, TwoOutputsMayBothBeDevNull) {
  EXPECT_EQ(run(small("solve", {"--plan", "/dev/null", "--json", "/dev/null"})).code, 0);
}

TEST_F(OutputTest, AReaderThatLeavesDoesNoHarm) {
  // A pipe nobody reads any more: every write to it fails, and SIGPIPE would kill.
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ::close(ends[0]);
  const std::string closed_pipe = "/dev/fd/" + std::to_string(ends[1]);
  const Finished finished = run(small("solve", {"--plan", path("p.json"), "--json", closed_pipe}));
  ::close(ends[1]);
  EXPECT_EQ(finished.signal, 0);
  EXPECT_EQ(finished.code, 74);
  EXPECT_TRUE(json::accept(read("p.json")));
}

}  // namespace
}  // namespace quadrille::cli::test
