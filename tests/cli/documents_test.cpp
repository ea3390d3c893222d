// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "cli/process.hpp"

namespace quadrille::cli::test {
namespace {

using testing::HasSubstr;

constexpr const char* kCommands[] = {"solve",    "explain",  "verify", "info",
                                     "generate", "convert",  "view",   "execute-check",
                                     "simulate", "dispatch", "export", "campaign"};

class DocumentsTest : public CliTest {
 protected:
  std::set<std::string> options_of(const std::string& command) {
    const std::string help = run({command, "--help"}).out;
    // Up to the footer, whose examples belong to no list of options.
    const std::string list = help.substr(0, help.find("\nExample"));
    std::set<std::string> options;
    const std::regex option("(^|\n)  (-h,)?(--[a-z-]+)");
    for (std::sregex_iterator at(list.begin(), list.end(), option), end; at != end; ++at)
      options.insert((*at)[3]);
    return options;
  }
  static std::string source(const std::string& name) {
    std::ifstream in(std::string(QUADRILLE_SOURCE_DIR "/") + name);
    std::ostringstream text;
    text << in.rdbuf();
    EXPECT_FALSE(text.str().empty()) << name;
    return text.str();
  }
  /// From the line `begin` to the line `end`.
  static std::string section(const std::string& text, const std::string& begin,
                             const std::string& end) {
    const auto from = text.find(begin);
    EXPECT_NE(from, std::string::npos) << begin;
    if (from == std::string::npos) return "";
    return text.substr(from, text.find(end, from + begin.size()) - from);
  }
};

TEST_F(DocumentsTest, TheManPageNamesEveryOptionOfEveryCommand) {
  std::string man = source("cli/man/quadrille.1");
  man = std::regex_replace(man, std::regex(R"(\\-)"), "-");
  for (const std::string command : kCommands) {
    const std::string part = section(man, ".SS \"quadrille " + command, "\n.S");
    const std::string shared = section(man, ".SS \"Options that name an instance", "\n.S");
    for (const std::string& option : options_of(command)) {
      const std::string where = command == "generate" ? part : part + shared;
      EXPECT_THAT(where, testing::AnyOf(HasSubstr(option + "\n"), HasSubstr(option + " ")))
          << command;
    }
  }
  EXPECT_THAT(man, HasSubstr(".TH QUADRILLE 1"));
  for (const char* code : {"0", "1", "10", "20", "30", "64", "65", "70", "74"})
    EXPECT_THAT(man, HasSubstr(std::string("\n.B ") + code + "\n"));
}

TEST_F(DocumentsTest, EachCommandHasAManPageWithItsOptionsAndNoOthers) {
  const auto page = [](const std::string& name) {
    std::ifstream in(QUADRILLE_MAN_PAGES "/" + name + ".1");
    std::ostringstream text;
    text << in.rdbuf();
    EXPECT_FALSE(text.str().empty()) << name;
    return std::regex_replace(text.str(), std::regex(R"(\\-)"), "-");
  };
  EXPECT_THAT(page("quadrille"), HasSubstr("\"quadrille " QUADRILLE_VERSION "\""));
  // The commands of the program, no matter which this file knows.
  const std::string help = run({"--help"}).out, title = "\nSubcommands:\n";
  const std::string list = section(help + "\n\n", title, "\n\n");
  const std::regex name("\n  ([a-z-]+)"), option("\n\\.BI? (--[a-z-]+)");
  int commands = 0;
  for (std::sregex_iterator at(list.begin(), list.end(), name), end; at != end; ++at, ++commands) {
    const std::string command = (*at)[1], man = page("quadrille-" + command);
    SCOPED_TRACE(command);
    std::set<std::string> named;
    for (std::sregex_iterator in(man.begin(), man.end(), option); in != end; ++in)
      named.insert((*in)[1]);
    EXPECT_EQ(named, options_of(command));
    EXPECT_THAT(man, HasSubstr("\"quadrille " QUADRILLE_VERSION "\""));
    EXPECT_THAT(man, HasSubstr("\n.SH NAME\nquadrille-" + command + " - "));
    EXPECT_THAT(man, HasSubstr("\n.SH SYNOPSIS\n.B quadrille " + command + "\n.RI [ options ]"));
    EXPECT_THAT(man, HasSubstr("\n.SH DESCRIPTION\n"));
    EXPECT_THAT(man, HasSubstr("\n.SH \"EXIT STATUS\"\n.TP\n.B 0\n"));
  }
  EXPECT_EQ(commands, static_cast<int>(std::size(kCommands)));
}

TEST_F(DocumentsTest, WhateverNamesTheVersionNamesThisOne) {
  const std::string version = QUADRILLE_VERSION;
  const std::string minor = version.substr(0, version.rfind('.'));
  EXPECT_THAT(source("package.xml"), HasSubstr("<version>" + version + "</version>"));
  EXPECT_THAT(source("CITATION.cff"), HasSubstr("\nversion: " + version + "\n"));
  EXPECT_THAT(source("CHANGELOG.md"), HasSubstr("\n## " + version + "\n"));
  for (const char* file : {"README.md", "docs/installing.md", "tests/consumer/CMakeLists.txt"})
    EXPECT_THAT(source(file), HasSubstr("find_package(quadrille " + minor + " REQUIRED"));
  EXPECT_THAT(source("docs/installing.md"), HasSubstr("`libquadrille" + minor + "`"));
}

TEST_F(DocumentsTest, TheManualNamesEveryOptionAndExitCode) {
  const std::string manual = source("docs/cli.md");
  for (const std::string command : kCommands)
    for (const std::string& option : options_of(command))
      EXPECT_THAT(manual, HasSubstr("`" + option)) << command;
  for (const char* code : {"0", "1", "10", "20", "30", "64", "65", "70", "74"})
    EXPECT_THAT(manual, HasSubstr(std::string("\n| ") + code + " |"));
}

TEST_F(DocumentsTest, TheCompletionOffersEveryOptionOfEveryCommand) {
  for (const std::string command : kCommands) {
    const std::set<std::string> options = options_of(command);
    ASSERT_GE(options.size(), 7u) << command;
    const std::string script =
        ". '" QUADRILLE_SOURCE_DIR "/cli/completion/quadrille.bash'; COMP_WORDS=(quadrille " +
        command + " --); COMP_CWORD=2; _quadrille; printf '%s\\n' \"${COMPREPLY[@]}\"";
    std::FILE* shell = ::popen(
        ("bash -c \"" + std::regex_replace(script, std::regex("[\"$]"), "\\$&") + "\"").c_str(),
        "r");
    ASSERT_NE(shell, nullptr);
    std::set<std::string> offered;
    char line[256];
    while (std::fgets(line, sizeof line, shell) != nullptr)
      offered.insert(std::string(line).substr(0, std::string(line).find('\n')));
    EXPECT_EQ(::pclose(shell), 0);
    EXPECT_EQ(offered, options) << command;
  }
}

TEST_F(DocumentsTest, TheExampleOfTheManualIsReal) {
  // docs/cli.md shows this run; the seconds of a search differ.
  std::filesystem::current_path(QUADRILLE_SOURCE_DIR);
  const std::string manual = source("docs/cli.md");
  const std::string command =
      "quadrille solve --map examples/maps/roundabout.map --scen "
      "examples/maps/roundabout.scen --agents 4";
  ASSERT_THAT(manual, HasSubstr("$ " + command + "\n"));
  const Finished finished = run({"solve", "--map", "examples/maps/roundabout.map", "--scen",
                                 "examples/maps/roundabout.scen", "--agents", "4"});
  const std::regex measured("search     .*\n");
  EXPECT_THAT(std::regex_replace(manual, measured, ""),
              HasSubstr(std::regex_replace(finished.out, measured, "")));
}

TEST_F(DocumentsTest, TheRunInTheReadmeIsReal) {
  // What scripts/solve does without arguments; without pictures, seconds and the way to the files.
  const std::string maps = QUADRILLE_SOURCE_DIR "/examples/maps/meeting";
  const Finished finished =
      run({"solve", "--map", maps + ".map", "--scen", maps + ".scen", "--agents", "6"});
  const std::regex root(QUADRILLE_SOURCE_DIR "/"), measured("search     [^,]*,");
  const auto stable = [&](const std::string& text) {
    return std::regex_replace(std::regex_replace(text, measured, "search"), root, "…/");
  };
  const std::string out = stable(finished.out), readme = stable(source("README.md"));
  EXPECT_THAT(readme, HasSubstr(out.substr(0, out.find("\n\n"))));
  EXPECT_THAT(readme, HasSubstr(out.substr(out.rfind("\n\n") + 2)));
}

TEST_F(DocumentsTest, TheRunInContinuousTimeInTheReadmeIsReal) {
  std::filesystem::current_path(QUADRILLE_SOURCE_DIR);
  const Finished finished = run({"solve", "--instance", "examples/maps/siding.json"});
  const std::regex measured("search     .*\n");  // the search itself may change
  EXPECT_EQ(finished.code, 0);
  EXPECT_THAT(std::regex_replace(source("README.md"), measured, ""),
              HasSubstr("$ scripts/solve --instance examples/maps/siding.json\n" +
                        std::regex_replace(finished.out, measured, "") + "```"));
}

TEST_F(DocumentsTest, TheRobotsOfTheReadmeArrive) {
  // All commands about one file that it makes itself, one after the other.
  std::filesystem::current_path(folder_);
  std::istringstream lines(source("README.md"));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("    ") || line.find(" d.json") == std::string::npos) continue;
    std::istringstream words(line.substr(0, line.find(" #")));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) {
      if (word == "scripts/solve")
        arguments.push_back("solve");
      else if (word != "build/release/cli/quadrille")
        arguments.push_back(word);
    }
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.code, 0) << line << "\n" << finished.out << finished.err;
    ++count;
  }
  EXPECT_EQ(count, 7u);
  EXPECT_TRUE(exists("orders.json"));
}

TEST_F(DocumentsTest, TheProgramInTheReadmeIsAnExampleThatTheTestsRun) {
  const std::string example = source("examples/two_agents.cpp"), readme = source("README.md");
  EXPECT_THAT(readme, HasSubstr("```cpp\n" + example.substr(example.find('\n') + 1) + "```"));
  const std::string expected = source("examples/two_agents.expected");
  EXPECT_THAT(readme, HasSubstr("prints `" + expected.substr(0, expected.find('\n')) + "`"));
}

}  // namespace
}  // namespace quadrille::cli::test
