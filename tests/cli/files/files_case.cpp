// SPDX-License-Identifier: MIT
#include "cli/files/files_case.hpp"

#include <algorithm>

#include "cli/files/contents.hpp"

namespace quadrille::cli::test {
namespace {

using nlohmann::json;

/// What a solve writes plans as.
std::string format_of(const Words& words, const std::string& file, bool in_time) {
  const auto given = std::find(words.begin(), words.end(), "--plan-format");
  if (given != words.end()) return *(given + 1);
  if (in_time) return file.ends_with(".xml") ? "ccbs" : "json";
  return file.ends_with(".yaml") || file.ends_with(".yml") ? "yaml" : "json";
}

}  // namespace

FilesCase::FilesCase(std::uint64_t seed) : random_(seed), names_(random_) {}

std::string FilesCase::problem() {
  try {
    run();
  } catch (const Problem& problem) {
    return problem.what + "\n" + workshop_.history();
  } catch (const json::exception& error) {
    return std::string(error.what()) + "\n" + workshop_.history();
  }
  return "";
}

Ended FilesCase::must(const Words& words, std::initializer_list<int> codes) {
  Ended ended = workshop_.run(words);
  if (std::find(codes.begin(), codes.end(), ended.code) == codes.end())
    fail("exit code " + std::to_string(ended.code));
  return ended;
}

Ended FilesCase::on_input(const std::string& command, const Words& more,
                          std::initializer_list<int> codes) {
  return must(Words{command} + input_.options + more, codes);
}

void FilesCase::expect(const std::string& what, const std::string& why_not) {
  if (!why_not.empty()) fail(what + ": " + why_not);
}

void FilesCase::run() {
  input_ = random_.percent(50) ? draw_roadmap(random_, workshop_, names_)
                               : draw_steps(random_, workshop_, names_);
  // Bodies may overlap, and goals be out of reach; that is said by all commands.
  if (workshop_.run(Words{"info"} + input_.options).code != 0) return overlapping();
  convert_instance();
  if (!input_.map.empty()) generate_more();
  if (!solve()) return;
  if (!outputs_.plan.empty()) read_plan(outputs_.plan, plan_format_);
  if (!outputs_.json.empty()) read_plan(outputs_.json, "json");
  if (random_.percent(30)) explain();
  for (std::size_t k = random_.below(3); k > 0; --k) break_plan(json_plan_);
}

void FilesCase::overlapping() {
  if (!input_.in_time) fail("info refuses an instance");
  const std::string result = names_.next(".json");
  on_input("solve", {"--json", result, "--quiet"}, {20});
  expect(result, why_no_json(read_file(result)));
  on_input("convert", {"--to", "json"}, {65});
  on_input("verify", {result}, {65});
}

bool FilesCase::solve() {
  const Words outputs = draw_outputs(random_, input_, names_, outputs_);
  Words words = draw_search(random_, input_, !outputs_.json.empty()) + outputs;
  plan_format_ = format_of(words, outputs_.plan, input_.in_time);
  std::string& to_stdout = random_.percent(50) ? outputs_.plan : outputs_.json;
  const bool every = std::find(words.begin(), words.end(), "--plan-every") != words.end();
  int code = 0;
  words = Words{"solve"} + input_.options + words;
  if (!to_stdout.empty() && !every && random_.percent(15)) {
    std::replace(words.begin(), words.end(), to_stdout, std::string("-"));
    if (&to_stdout == &outputs_.plan) plan_format_ = format_of(words, "-", input_.in_time);
    code = workshop_.run_into(to_stdout, words).code;
  } else {
    code = workshop_.run(words).code;
  }
  if (code != 0 && code != 10 && code != 20 && code != 30)
    fail("exit code " + std::to_string(code));
  const bool has_plan = code == 0 || code == 10;
  const auto objective = std::find(words.begin(), words.end(), "--objective");
  objective_ = objective == words.end() ? Words{} : Words{objective[0], objective[1]};
  look_at_outputs(has_plan, code);
  return has_plan;
}

void FilesCase::look_at_outputs(bool has_plan, int code) {
  if (!outputs_.json.empty()) {
    const std::string text = read_file(outputs_.json);
    expect(outputs_.json, why_no_json(text));
    const json result = json::parse(text);
    if (has_plan) bound_ = result.at("lower_bound").dump();
    if (has_plan == result.at("plan").is_null()) fail("the result has no plan, or one too much");
    if (!has_plan &&
        on_input("verify", {outputs_.json}, {65}).err.find("there is no plan") == std::string::npos)
      fail("it has to be said that there is no plan");
  }
  if (!outputs_.plan.empty() && outputs_.plan != outputs_.json &&
      has_plan != !read_file(outputs_.plan).empty())
    fail("the plan file is not as the exit code says");
  if (has_plan && !outputs_.svg.empty()) expect(outputs_.svg, why_no_xml(read_file(outputs_.svg)));
  if (!outputs_.view.empty() && code != 30)
    expect(outputs_.view, why_no_page(read_file(outputs_.view)));
}

void FilesCase::explain() {
  const std::string result = names_.next(".json"), page = names_.next(".html");
  Words words = objective_ + Words{"--json", result, "--view", page, "--cpu-limit", "2"};
  if (random_.percent(50)) words = words + Words{"--conflict-limit", "30"};
  const int code = on_input("explain", words, {0, 10, 20, 30}).code;
  expect(result, why_no_json(read_file(result)));
  if (code != 30) expect(page, why_no_page(read_file(page)));
  if (code == 0 || code == 10) read_plan(result, "json");
}

void FilesCase::convert_instance() {
  const std::string file = names_.next(random_.percent(50) ? ".json" : ".yaml");
  on_input("convert", {"--to", "json", "--output", file}, {0});
  const std::string text = read_file(file);
  expect(file, why_no_json(text));
  const Words again = {"convert", "--instance", file, "--to"};
  if (must(again + Words{"json"}, {0}).out != text) fail("the instance is another one");
  must({"info", "--instance", file}, {0});
  if (input_.in_time || !input_.has_cells) {
    must(again + Words{"yaml"}, {64, 65});
    return;
  }
  const std::string yaml = names_.next(random_.percent(50) ? ".yaml" : ".json");
  must(again + Words{"yaml", "--output", yaml}, {0});
  const std::string back = must({"convert", "--instance", yaml, "--to", "json"}, {0}).out;
  json now = json::parse(back), before = json::parse(text);
  // The YAML format has a name for each agent.
  for (json* instance : {&now, &before})
    for (json& agent : instance->at("agents")) agent.erase("name");
  if (now != before) fail("the instance is another one");
  must({"info", "--instance", yaml}, {0});
  if (random_.percent(50)) input_.options = {"--instance", random_.percent(50) ? yaml : file};
}

void FilesCase::generate_more() {
  const bool knows_letters = input_.map.size() == 2;
  const std::string scenario = names_.next(random_.percent(50) ? ".scen" : "");
  const Words words = Words{"generate", input_.map[0], input_.map[1]} +
                      Words{"--agents", "1", "--scen-output", scenario};
  if (must(words, {0, 65}).code != 0) {
    if (knows_letters) fail("a map is refused");
    return;
  }
  must(Words{"info"} + input_.map + Words{"--scen", scenario}, {0});
  if (!knows_letters) return;
  // The same files in continuous time; their names do not say what they are.
  const std::string map = names_.next(random_.percent(50) ? ".map" : "");
  write_file(map, read_file(input_.map[1]));
  must({"info", "--roadmap", map, "--task", scenario, "--radius", "0.2"}, {0});
}

}  // namespace quadrille::cli::test
