// SPDX-License-Identifier: MIT
// All that reads a file with a plan.
#include <algorithm>
#include <set>

#include "cli/files/contents.hpp"
#include "cli/files/files_case.hpp"

namespace quadrille::cli::test {

using nlohmann::json;

std::string FilesCase::as_json(const std::string& file, const std::string& format, json& plan) {
  std::string made = names_.next(".json");
  Words words = {"--to", "json", "--output", made, file};
  if (random_.percent(50)) words = words + Words{"--from", format};
  on_input("convert", words, {0});
  const std::string text = read_file(made);
  expect(made, why_no_json(text));
  plan = plan_in(text);
  return made;
}

void FilesCase::read_plan(const std::string& file, const std::string& format) {
  Words words = {file};
  if (random_.percent(50)) words = words + Words{"--plan-format", format};
  if (input_.in_time && random_.percent(30)) words = words + Words{"--check-with", "fcl"};
  const std::string verdict = names_.next(".json");
  on_input("verify", words + Words{"--json", verdict}, {0});
  expect(verdict, why_no_json(read_file(verdict)));

  json plan;
  const std::string made = as_json(file, format, plan);
  if (format == "json" && plan_in(read_file(file)) != plan) fail("the plan is another one");
  if (json_plan_.empty()) json_plan_ = made;
  if (random_.percent(40)) convert_there_and_back(file, format);
  if (random_.percent(25)) view(file);
  if (random_.percent(25)) execute(file);
  if (input_.in_time && random_.percent(25)) export_it(file);
  if (random_.percent(40)) begin_with(file);
}

void FilesCase::convert_there_and_back(const std::string& file, const std::string& format) {
  json before, after;
  as_json(file, format, before);
  for (const std::string& to : plan_formats(input_)) {
    const std::string made = names_.next(random_.percent(50) ? "." + to : "");
    on_input("convert", {"--to", to, "--output", made, file}, {0});
    on_input("verify", {made}, {0});
    as_json(made, to, after);
    if (before != after) fail("the plan is another one as " + to);
  }
}

void FilesCase::view(const std::string& file) {
  const std::string page = names_.next(".html"), picture = names_.next(".svg");
  Words words = {"--output", page, file};
  const bool draws = random_.percent(70);
  if (draws) words = words + Words{"--svg", picture} + draw_picture(random_, input_);
  on_input("view", words, {0});
  expect(page, why_no_page(read_file(page)));
  if (draws) expect(picture, why_no_xml(read_file(picture)));
}

void FilesCase::execute(const std::string& file) {
  if (input_.is_no_order) {
    on_input("execute-check", {file}, {65});
    on_input("simulate", {file}, {65});
    return;
  }
  const std::string order = names_.next(".json"), report = names_.next(".json");
  const Words check{"--json", order, file};
  const Ended checked = input_.may_block ? on_input("execute-check", check, {0, 1, 65})
                                         : on_input("execute-check", check, {0, 1});
  if (checked.code == 65) {
    if (checked.err.find("where nobody may wait") == std::string::npos)
      fail("a plan cannot be carried out");
    on_input("simulate", {file}, {65});
    return;
  }
  expect(order, why_no_json(read_file(order)));
  // Units of time are of all sizes here, and plans may be short.
  const double tick = json::parse(read_file(order)).at("tick");
  Words words = {"--runs", "2", "--json", report, "--longest", number_text(20 * tick), file};
  if (random_.percent(50)) words = words + Words{"--delays", "0.5"};
  if (random_.percent(30)) words = words + Words{"--rule", "coupled", "--seed", "3"};
  on_input("simulate", words, {0});
  expect(report, why_no_json(read_file(report)));
}

void FilesCase::export_it(const std::string& file) {
  for (const std::string to : {"csv", "multidof", "path", "vda5050"}) {
    const std::string made = names_.next("." + to);
    const bool is_order = to == "vda5050";
    Words words = {"--to", to, "--output", made, file};
    if (is_order && (input_.has_heights || input_.is_no_order)) {
      on_input("export", words, {65});
      continue;
    }
    // Units of time are of all sizes here, and the seconds of messages end.
    if (!is_order) words = words + Words{"--rate", "1e-6"};
    const Ended ended = is_order && input_.may_block ? on_input("export", words, {0, 1, 65})
                        : is_order                   ? on_input("export", words, {0, 1})
                        : to == "csv"                ? on_input("export", words, {0})
                                                     : on_input("export", words, {0, 65});
    if (ended.code == 65 && ended.err.find("the times of ROS end at") == std::string::npos &&
        !(input_.may_block && ended.err.find("where nobody may wait") != std::string::npos))
      fail("a plan cannot be written as " + to);
    if (ended.code != 0) continue;
    const std::string text = read_file(made);
    expect(made, to == "csv" ? why_no_table(text) : why_no_json(text));
  }
}

void FilesCase::begin_with(const std::string& file) {
  const std::string result = names_.next(".json");
  Words words = objective_ + Words{"--initial-plan", file, "--json", result, "--cpu-limit", "2"};
  // Which it may replace.
  std::string plan = file;
  if (random_.percent(50)) {
    plan = names_.next(".plan");
    write_file(plan, read_file(file));
    words = objective_ +
            Words{"--initial-plan", plan, "--json", result, "--cpu-limit", "2", "--plan", plan};
  }
  if (random_.percent(50)) words = words + Words{"--conflict-limit", "10"};
  if (random_.percent(30)) words = words + Words{"--known-plan", file};
  if (!bound_.empty() && random_.percent(30)) words = words + Words{"--known-bound", bound_};
  on_input("solve", words, {0, 10});
  on_input("verify", {plan}, {0});
  on_input("verify", {result}, {0});
  const std::string verdict = names_.next(".json");
  on_input("verify", {"--quiet", "--json", verdict, file}, {0});
  const bool is_makespan = !objective_.empty() && objective_.back() == "makespan";
  const json before = json::parse(read_file(verdict)).at(is_makespan ? "makespan" : "sum_of_costs");
  if (json::parse(read_file(result)).at("cost") > before)
    fail("it costs more than the plan that it began with");
}

namespace {

/// What a verdict says, or only which rules are broken.
json violations(const json& verdict, bool only_kinds) {
  json found = verdict.at("violations");
  if (!only_kinds) return found;
  std::set<std::string> kinds;
  for (const json& one : found) kinds.insert(one.at("kind"));
  return kinds;
}

/// Each stop but the last has a departure.
void settle_departures(json& path) {
  for (std::size_t k = 0; k < path.size(); ++k)
    if (k + 1 == path.size())
      path[k].erase("depart_ticks");
    else if (!path[k].contains("depart_ticks"))
      path[k]["depart_ticks"] = path[k]["arrive_ticks"];
}

/// One change to a path; `plan` is the list of this project's JSON.
void change(Random& random, json& plan, bool in_time) {
  if (plan.empty()) return;
  json& path = plan[random.below(plan.size())];
  json& stop = path[random.below(path.size())];
  if (in_time)
    for (json& other : path)
      for (const char* key : {"at", "arrive", "depart"}) other.erase(key);
  switch (random.below(6)) {
    case 0:  // An agent less.
      plan.erase(plan.size() - 1);
      return;
    case 1:  // And one more.
      plan.push_back(path);
      return;
    case 2:
      if (path.size() > 1) path.erase(random.below(path.size() - 1));
      return;
    case 3:
      path.insert(path.begin() + static_cast<std::ptrdiff_t>(random.below(path.size())), stop);
      return;
    default:
      break;
  }
  if (!in_time) {
    const json& other = plan[random.below(plan.size())];
    stop = other[random.below(other.size())];
    return;
  }
  const char* key = random.percent(50) ? "arrive_ticks" : "depart_ticks";
  if (random.percent(25) || !stop.contains(key)) {
    stop["vertex"] = path[random.below(path.size())]["vertex"];
    return;
  }
  const std::vector<std::int64_t> steps = {-1, 1, 2, -3, 500};
  stop[key] = std::max<std::int64_t>(0, stop[key].get<std::int64_t>() + random.pick(steps));
}

}  // namespace

void FilesCase::break_plan(const std::string& file) {
  const json whole = json::parse(read_file(file));
  json broken = {{"quadrille", "plan"}, {"version", 1}, {"plan", whole.at("plan")}};
  if (input_.in_time) broken["resolution"] = whole.at("resolution");
  for (std::size_t k = random_.between(1, 3); k > 0; --k)
    change(random_, broken["plan"], input_.in_time);
  if (input_.in_time)
    for (json& path : broken["plan"]) settle_departures(path);
  const std::string made = names_.next(".json"), verdict = names_.next(".json");
  write_file(made, broken.dump());
  on_input("verify", {"--quiet", "--json", verdict, made}, {0, 1});
  const json before = json::parse(read_file(verdict));
  for (const std::string& to : plan_formats(input_)) {
    const std::string other = names_.next("");
    // What a format cannot express is refused.
    if (on_input("convert", {"--to", to, "--output", other, made}, {0, 65}).code != 0) {
      if (to != "ccbs") fail("a plan that breaks rules cannot be written as " + to);
      continue;
    }
    on_input("verify", {"--quiet", "--json", verdict, other}, {0, 1});
    const json after = json::parse(read_file(verdict));
    // There all paths are as long as the longest: they end later, and of several agents in one
    // place others are named.
    const bool is_stretched = to == "visualizer" || to == "lacam";
    if (violations(after, is_stretched) != violations(before, is_stretched))
      fail("other rules are broken by the same plan as " + to);
  }
  if (random_.percent(20)) view(made);
  if (random_.percent(20)) on_input("execute-check", {made, "--quiet"}, {0, 1, 65});
}

}  // namespace quadrille::cli::test
