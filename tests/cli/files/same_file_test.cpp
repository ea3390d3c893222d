// SPDX-License-Identifier: MIT
// No two outputs go to one file, and no output to an input, however the names are written: all
// commands, all their outputs, random spellings of names. QUADRILLE_TEST_SCALE multiplies the
// number of cases.
#include <gmock/gmock.h>

#include <map>

#include "cli/files/commands.hpp"
#include "cli/files/inputs.hpp"
#include "support/environment.hpp"

namespace quadrille::cli::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A command with its inputs, and the options that name its outputs.
struct Command {
  Words words;
  std::vector<std::string> outputs;
  std::vector<std::string> inputs;  // Names of files.
};

/// Commands on an instance with one plan, in the working directory of a workshop.
std::vector<Command> commands(bool in_time) {
  const Words input = in_time ? Words{"--instance", "i.json"}
                              : Words{"--map", "m.map", "--scen", "s.scen", "--agents", "1"};
  const std::vector<std::string> files =
      in_time ? std::vector<std::string>{"i.json"} : std::vector<std::string>{"m.map", "s.scen"};
  std::vector<std::string> with_plan = files;
  with_plan.emplace_back("p.json");
  std::vector<Command> all = {
      {Words{"solve"} + input, {"--plan", "--json", "--view", "--svg"}, files},
      {Words{"solve"} + input + Words{"--known-plan", "p.json"}, {"--plan", "--json"}, with_plan},
      {Words{"solve"} + input + Words{"--initial-plan", "p.json"}, {"--json", "--svg"}, with_plan},
      {Words{"explain"} + input, {"--json", "--view"}, files},
      {Words{"verify", "p.json"} + input, {"--json"}, with_plan},
      {Words{"view", "p.json"} + input, {"--output", "--svg"}, with_plan},
      {Words{"convert", "p.json", "--to", "json"} + input, {"--output"}, with_plan},
      {Words{"convert", "--to", "json"} + input, {"--output"}, files},
      {Words{"execute-check", "p.json"} + input, {"--json"}, with_plan},
      {Words{"simulate", "p.json", "--runs", "1"} + input, {"--json"}, with_plan}};
  if (in_time) {
    all.push_back({Words{"export", "p.json", "--to", "csv"} + input, {"--output"}, with_plan});
    return all;
  }
  const Words agents = {"--agents", "1"};
  all.push_back(
      {Words{"generate", "--kind", "empty"} + agents, {"--map-output", "--scen-output"}, {}});
  all.push_back({Words{"generate", "--map", "m.map"} + agents, {"--scen-output"}, {"m.map"}});
  return all;
}

void prepare(Workshop& workshop, bool in_time) {
  write_file(
      "i.json",
      R"({"quadrille": "instance", "version": 1, "resolution": {"length": 0.001, "time": 0.01},
 "roadmap": {"vertices": [[0, 0], [2, 0]], "edges": [[0, 1], [1, 0]]},
 "agents": [{"start": 0, "goal": 1, "radius": 0.3}]})");
  write_file("m.map", "type octile\nheight 1\nwidth 3\nmap\n...\n");
  write_file("s.scen", "version 1\n0\tm.map\t3\t1\t0\t0\t2\t0\t2\n");
  fs::create_directory("sub");
  fs::create_directory_symlink(".", "here");
  fs::create_directory_symlink("in", "../beside");
  Words words = commands(in_time).front().words + Words{"--plan", "p.json", "--quiet"};
  ASSERT_EQ(workshop.run(words).code, 0) << workshop.history();
}

/// Another spelling of the name of a file, which need not exist. Makes links where it takes some.
std::string respelled(Random& random, const std::string& file) {
  static int count = 0;
  const std::string link = "link" + std::to_string(++count);
  const fs::path folder = fs::current_path();
  switch (random.below(fs::exists(file) ? 10 : 9)) {
    case 0:
      return file;
    case 1:
      return "./" + file;
    case 2:
      return "sub/.././/" + file;
    case 3:
      return folder / file;
    case 4:
      return "here/here/" + file;
    case 5:
      return folder.parent_path() / "beside" / file;
    case 6:
      fs::create_symlink(file, link);
      return link;
    case 7:
      fs::create_symlink(folder.parent_path() / "beside" / file, link);
      fs::create_symlink(link, link + "b");
      return "./" + link + "b";
    case 8:
      fs::create_symlink("../" + file, "sub/" + link);
      return "here/sub/" + link;
    default:
      fs::create_hard_link(file, link);
      return link;
  }
}

/// Names and contents.
std::map<std::string, std::string> contents() {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::current_path()))
    if (entry.is_regular_file()) files[entry.path()] = read_file(entry.path());
  return files;
}

class SameFile : public testing::TestWithParam<bool> {
 protected:
  /// Two options of the command, or one and an input, that lead to one file.
  void clash(Random& random) {
    Workshop workshop;
    prepare(workshop, GetParam());
    const auto all = commands(GetParam());
    const Command& command = all[random.below(all.size())];
    const std::string first = random.pick(command.outputs);
    Words words = command.words;
    std::string wanted = "is an input of this run";
    const bool two = command.inputs.empty() || (command.outputs.size() > 1 && random.percent(60));
    if (two) {
      std::string second = first;
      while (second == first) second = random.pick(command.outputs);
      if (random.percent(50)) write_file("new", "old");
      words = words + Words{second, respelled(random, "new")};
      wanted = "name the same output";
    }
    const std::string file = two ? "new" : random.pick(command.inputs);
    words = words + Words{first, respelled(random, file)};
    const auto before = contents();
    const Ended ended = workshop.run(words);
    EXPECT_EQ(ended.code, 64) << workshop.history();
    EXPECT_THAT(ended.err, HasSubstr(wanted)) << workshop.history();
    EXPECT_EQ(contents(), before) << workshop.history();
    // The names were wrong, and nothing else.
    for (std::size_t k = command.words.size() + 1; k < words.size(); k += 2)
      words[k] = "other" + std::to_string(k);
    EXPECT_EQ(workshop.run(words).code, 0) << workshop.history();
  }
};

TEST_P(SameFile, IsRefused) {
  for (std::uint64_t seed = 0; seed < support::scaled(150); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    clash(random);
    if (HasFailure()) return;
  }
}

TEST_P(SameFile, TheInitialPlanMayBeReplaced) {
  for (std::uint64_t seed = 0; seed < support::scaled(20); ++seed) {
    Random random(seed);
    Workshop workshop;
    prepare(workshop, GetParam());
    const Words words =
        commands(GetParam()).front().words +
        Words{"--initial-plan", respelled(random, "p.json"), "--plan", respelled(random, "p.json")};
    EXPECT_EQ(workshop.run(words).code, 0) << workshop.history();
  }
}

TEST_P(SameFile, WhatIsSaidOnStandardOutputIsAnOutput) {
  Workshop workshop;
  prepare(workshop, GetParam());
  for (const Command& command : commands(GetParam())) {
    const std::string name = command.words.front();
    if (name == "generate") continue;
    const bool speaks = name != "view" && name != "convert" && name != "export";
    for (const std::string& option : command.outputs) {
      SCOPED_TRACE(name + " " + option);
      fs::remove("new");
      const int code = workshop.run_into("new", command.words + Words{option, "./new"}).code;
      EXPECT_EQ(code == 64, speaks) << workshop.history();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Domains, SameFile, testing::Bool(), [](const auto& domain) {
  return domain.param ? std::string("Roadmaps") : std::string("Steps");
});

}  // namespace
}  // namespace quadrille::cli::test
