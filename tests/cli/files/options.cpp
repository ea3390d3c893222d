// SPDX-License-Identifier: MIT
#include "cli/files/options.hpp"

namespace quadrille::cli::test {
namespace {

/// "name value" with so many per cent.
void maybe(Random& random, std::size_t percent, Words& words, const std::string& name,
           const std::vector<std::string>& values) {
  if (!random.percent(percent)) return;
  words.push_back(name);
  if (!values.empty()) words.push_back(random.pick(values));
}

/// Of timesteps.
void add_system(Random& random, Words& words, bool is_dpll) {
  const std::string system =
      is_dpll ? "dpll" : random.pick<std::string>({"dpll", "dpll-mdd", "smt-cbs", "mdd-sat"});
  if (!is_dpll || random.percent(30)) words = words + Words{"--system", system};
  if (!is_dpll && system.starts_with("dpll"))
    maybe(random, 40, words, "--check", {"watch", "propagate", "1/2,3/4", "2/3"});
  maybe(random, 30, words, "--cost-search", {"iterative", "core-guided"});
  maybe(random, 30, words, "--mdd-growth", {"on-demand", "full"});
  maybe(random, 30, words, "--forbid-first", {});
  maybe(random, 30, words, "--backtracking", {"chronological", "jump"});
  maybe(random, 30, words, "--no-first-plan", {});
}

}  // namespace

Words draw_search(Random& random, const Input& input, bool has_json) {
  Words words;
  maybe(random, 60, words, "--objective", {"sum-of-costs", "makespan"});
  const bool explains = random.percent(30);
  if (input.in_time)
    maybe(random, 40, words, "--system", {"dpll", "smt-cbs"});
  else
    add_system(random, words, explains || input.has_goal_sets);
  if (explains) words.emplace_back("--explain");
  if (!explains && random.percent(25)) {
    words = words + Words{"--threads", "2"};
    maybe(random, 30, words, "--race", {});
  }
  maybe(random, 30, words, "--seed", {"1", "77", "2000000000"});
  maybe(random, 20, words, "--gap", {"0", "12.5", "1e3"});
  maybe(random, 20, words, "--known-bound", {"0"});
  maybe(random, 15, words, "--audit", {});
  maybe(random, 30, words, "--conflict-limit", {"0", "1", "20", "300"});
  maybe(random, 5, words, "--time-limit", {"0", "0.02"});
  maybe(random, 10, words, "--memory-limit", {"100000"});
  if (has_json) maybe(random, 40, words, "--history", {});
  if (input.in_time) maybe(random, 30, words, "--check-with", {"fcl"});
  // Nothing here takes that long but on a bad day.
  return words + Words{"--cpu-limit", "4"};
}

std::vector<std::string> plan_formats(const Input& input) {
  if (input.in_time) return {"json", "ccbs"};
  if (!input.has_cells) return {"json", "yaml"};
  return {"json", "cbsh2", "lns2", "visualizer", "lacam", "yaml"};
}

Words draw_picture(Random& random, const Input& input) {
  Words words;
  maybe(random, 70, words, "--svg-kind", {"map", "space-time", "waits"});
  if (input.num_agents > 0)
    maybe(random, 30, words, "--svg-agents", {std::to_string(input.num_agents - 1)});
  return words;
}

Words draw_outputs(Random& random, const Input& input, FileNames& names, Outputs& outputs) {
  Words words;
  const bool has_plan = random.percent(80);
  if (has_plan) {
    const std::vector<std::string> endings = {".json", ".yaml", ".yml", ".xml", ".txt", ".csv", ""};
    outputs.plan = names.next(random.pick(endings));
    words = words + Words{"--plan", outputs.plan};
    maybe(random, 60, words, "--plan-format", plan_formats(input));
    maybe(random, 20, words, "--plan-every", {"0", "0.001"});
  }
  if (!has_plan || random.percent(60)) {
    outputs.json = names.next(random.percent(70) ? ".json" : "");
    words = words + Words{"--json", outputs.json};
  }
  if (random.percent(30)) {
    outputs.view = names.next(".html");
    words = words + Words{"--view", outputs.view};
  }
  if (random.percent(30)) {
    outputs.svg = names.next(".svg");
    words = words + Words{"--svg", outputs.svg} + draw_picture(random, input);
  }
  maybe(random, 50, words, "--quiet", {});
  return words;
}

}  // namespace quadrille::cli::test
