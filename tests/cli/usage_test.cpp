// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

using UsageTest = CliTest;

TEST_F(UsageTest, VersionAndHelpGoToStdout) {
  const Finished version = run({"--version"});
  EXPECT_EQ(version.code, 0);
  // CaDiCaL is linked in: which one, and under which licence, is said too.
  EXPECT_EQ(version.out,
            "quadrille " QUADRILLE_VERSION
            " (MIT licence)\n"
            "with the SAT solver CaDiCaL " QUADRILLE_CADICAL_VERSION " (MIT licence)\n");
  EXPECT_GE(std::string(QUADRILLE_CADICAL_VERSION).size(), 3u);
  const Finished help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_EQ(help.err, "");
  for (const char* command :
       {"solve", "explain", "verify", "info", "generate", "convert", "view"}) {
    SCOPED_TRACE(command);
    EXPECT_THAT(help.out, HasSubstr(command));
    const Finished own = run({command, "--help"});
    EXPECT_EQ(own.code, 0);
    EXPECT_THAT(own.out, HasSubstr(std::string("Usage: quadrille ") + command));
    EXPECT_THAT(own.out, HasSubstr(std::string("Example")));
    EXPECT_THAT(own.out, HasSubstr(std::string("\n  quadrille ") + command));
    EXPECT_THAT(own.out, HasSubstr("Exit codes:"));
  }
}

TEST_F(UsageTest, WrongCommandLinesExitWith64AndNameTheCulprit) {
  const struct {
    std::vector<std::string> arguments;
    const char* culprit;
  } cases[] = {
      {{}, "subcommand"},
      {{"slove"}, "'slove'"},
      {{"--frob"}, "'--frob'"},
      {{"solve"}, "--map"},
      {{"solve", "--map", "m"}, "--scen"},
      {{"solve", "--map", "m", "--scen", "s"}, "--agents"},
      {{"solve", "--scen", "s", "--agents", "1"}, "--map"},
      {{"solve", "--instance", "i", "--map", "m"}, "--instance"},
      {{"solve", "--map", "-", "--scen", "-", "--agents", "3"}, "--map and --scen"},
      {{"solve", "--instance", "i", "--passable", "S"}, "--passable"},
      {{"solve", "--instance", "i", "--share-goals", "all"}, "--share-goals"},
      {{"solve", "--roadmap", "r", "--share-goals", "2"}, "--share-goals"},
      {{"solve", "--map", "m", "--scen", "s", "--agents", "1", "--share-goals", "0"}, "'0'"},
      {{"solve", "--map", "m", "--scen", "s", "--agents", "1", "--share-goals", "1x"}, "'1x'"},
      {{"solve", "--map", ""}, "--map"},
      {{"verify", "--instance", "i"}, "PLAN"},
      {{"info"}, "--map"},
      {{"info", "--map", "m", "--agents", "3"}, "--scen"},
      {{"generate"}, "--kind"},
      {{"generate", "--kind", "cave"}, "cave"},
      {{"generate", "--kind", "empty", "--map", "m"}, "--map"},
      {{"generate", "--kind", "empty", "--obstacles", "0.5"}, "--obstacles"},
      {{"generate", "--kind", "random", "--obstacles", "1.5"}, "--obstacles"},
      {{"generate", "--kind", "empty", "--width", "0"}, "--width"},
      {{"generate", "--kind", "empty", "--agents", "3"}, "--agents"},
      {{"generate", "--kind", "empty", "--scen-output", "-"}, "--agents"},
      {{"generate", "--kind", "empty", "--width", "999999", "--height", "999999"}, "999999"},
      {{"generate", "--map", "m"}, "--scen-output"},
      {{"view", "--instance", "i"}, "PLAN"},
      {{"view", "--instance", "i", "--svg-kind", "map", "p"}, "--svg"},
      {{"view", "--instance", "i", "--svg", "s", "--svg-kind", "cube", "p"}, "cube"},
      {{"view", "--instance", "i", "--svg", "s", "--svg-agents", "1,", "p"}, "'1,'"},
      {{"solve", "--map", "m", "--scen", "s", "--agents", "1", "--view", "-", "--json", "-"},
       "--view"},
      {{"convert", "--instance", "i"}, "--to"},
      {{"convert", "--instance", "i", "--to", "cbsh2"}, "PLAN"},
      {{"convert", "--instance", "i", "--to", "doc", "p"}, "doc"},
  };
  for (const auto& c : cases) {
    const Finished finished = run(c.arguments);
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    EXPECT_EQ(finished.code, 64);
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, HasSubstr(c.culprit));
    EXPECT_THAT(finished.err, HasSubstr("--help'"));
  }
}

TEST_F(UsageTest, WordsThatAreNotKnownAreNamedWithWhatWasProbablyMeant) {
  const struct {
    std::vector<std::string> arguments;
    const char* message;
  } cases[] = {
      {{"slove"}, "'slove' is no command; did you mean solve?"},
      {{"verfiy", "p"}, "'verfiy' is no command; did you mean verify?"},
      {{"frobnicate"}, "'frobnicate' is no command\n"},
      {{"--verison"}, "there is no option '--verison'; did you mean --version?"},
      {{"solve", "--agnets", "3", "--frob"},
       "there is no option '--agnets'; did you mean --agents?"},
      {{"solve", "--agents=3", "--frob", "--agnets"}, "there is no option '--frob'\n"},
      {{"solve", "--time-limt=3"}, "there is no option '--time-limt'; did you mean --time-limit?"},
      {{"solve", "--instance", "i", "map.map"}, "'map.map' was not expected"},
      {{"generate", "--with", "4"}, "there is no option '--with'; did you mean --width?"},
      {{"verify", "--jsn", "f"}, "there is no option '--jsn'; did you mean --json?"},
  };
  for (const auto& c : cases) {
    const Finished finished = run(c.arguments);
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    EXPECT_EQ(finished.code, 64);
    EXPECT_THAT(finished.err, testing::StartsWith(std::string("quadrille: ") + c.message));
  }
}

TEST_F(UsageTest, HelpShowsFlagsAsTheyAreWritten) {
  const std::string help = run({"solve", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("  --no-first-plan  "));
  EXPECT_THAT(help, testing::Not(HasSubstr("{false}")));
}

TEST_F(UsageTest, NumbersAreStrict) {
  const struct {
    const char* option;
    std::vector<std::string> wrong;
  } cases[] = {
      {"--agents",
       {"", "x", "12abc", "-1", "+1", "0x4", "1.5", " 1", "1 ", "99999999999999999999"}},
      {"--seed", {"", "-1", "1e3", "4294967296", "nan"}},
      {"--time-limit", {"", "x", "1s", "-1", "-0", "nan", "inf", "-inf", "1e999", "0x1p3", "1,5"}},
      {"--cpu-limit", {"nan", "-0.5", "infinity"}},
      {"--memory-limit", {"0", "-5", "1.5", "99999999999999999999"}},
      {"--conflict-limit", {"-1", "1e6", "9223372036854775808"}},
  };
  for (const auto& c : cases)
    for (const std::string& text : c.wrong) {
      SCOPED_TRACE(std::string(c.option) + " '" + text + "'");
      std::vector<std::string> arguments = {"solve", "--map", "m", "--scen", "s"};
      if (std::string(c.option) != "--agents")
        arguments = arguments + std::vector<std::string>{"--agents", "1"};
      const Finished finished = run(arguments + std::vector<std::string>{c.option, text});
      EXPECT_EQ(finished.code, 64);
      EXPECT_THAT(finished.err, HasSubstr(c.option));
    }
}

TEST_F(UsageTest, SolveOptionsThatContradictEachOther) {
  const struct {
    std::vector<std::string> more;
    const char* culprit;
  } cases[] = {
      {{"--agents", "2"}, "--agents"},  // given twice
      {{"--objective", "soc"}, "--objective"},
      {{"--system", "cbs"}, "--system"},
      {{"--check", "3/2"}, "--check"},
      {{"--check", "1/2,1/3"}, "--check"},
      {{"--check", "often"}, "--check"},
      {{"--check", "1/2", "--system", "smt-cbs"}, "--check"},
      {{"--cost-search", "binary"}, "--cost-search"},
      {{"--mdd-growth", "fast"}, "--mdd-growth"},
      {{"--plan-format", "yaml"}, "--plan-format"},
      {{"--plan", "p", "--plan-format", "xml"}, "--plan-format"},
      {{"--plan", "-", "--json", "-"}, "--plan and --json"},
      {{"--plan", path("x"), "--json", path("x")}, "--plan and --json"},
      {{"--plan", path("x"), "--json", path("./x")}, "--plan and --json"},
      {{"--json", path("small.map")}, "small.map is an input"},
      {{"--plan", path("small.scen")}, "small.scen is an input"},
      {{"surplus"}, "surplus"},
      {{"--frob"}, "--frob"},
  };
  for (const auto& c : cases) {
    const Finished finished = run(small("solve", c.more));
    SCOPED_TRACE(testing::PrintToString(c.more));
    EXPECT_EQ(finished.code, 64);
    EXPECT_THAT(finished.err, HasSubstr(c.culprit));
  }
  EXPECT_EQ(files(),
            (std::vector<std::string>{"corridor.map", "corridor.scen", "small.map", "small.scen"}));
  EXPECT_THAT(read("small.map"), HasSubstr("octile"));
}

}  // namespace
}  // namespace quadrille::cli::test
