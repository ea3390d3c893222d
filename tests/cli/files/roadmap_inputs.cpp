// SPDX-License-Identifier: MIT
// Instances with roadmaps, as files.
#include <array>
#include <charconv>
#include <sstream>
#include <utility>
#include <vector>

#include "cli/files/inputs.hpp"
#include "continuous/support/random_instance.hpp"
#include "quadrille/continuous/instance_json.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::cli::test {
namespace {

using continuous::Instance;

/// Some with resolutions of their own for lengths and times, and with all rules of fleets.
Input one_file(Random& random, FileNames& names) {
  continuous::test::RandomOptions options;
  options.num_vertices = random.between(2, 6);
  options.num_agents = random.between(1, 3);
  options.under_way_percent = 20;
  options.goal_sets_percent = 15;
  const auto drawn = continuous::test::random_instance(
      static_cast<std::uint32_t>(random.below(1U << 31)), options);
  const double length = draw_resolution(random);
  const double time = random.percent(50) ? length : draw_resolution(random);
  const Instance instance =
      Instance::make(drawn.shared_roadmap(), {drawn.agents().begin(), drawn.agents().end()},
                     continuous::Resolution(length, time), {}, drawn.obstacles())
          .value();
  std::ostringstream text;
  QUADRILLE_REQUIRE(!write_instance_json(text, "", instance), "it can be written");
  const std::vector<std::string> endings = {".json", ".json", ".txt", ".yaml", ""};
  Input input;
  const std::string file = names.next(random.pick(endings));
  write_file(file, text.str());
  input.options = {"--instance", file};
  input.has_heights = !instance.roadmap().is_flat();
  input.is_no_order = !instance.obstacles().empty();
  input.may_block = !instance.roadmap().no_waiting().empty();
  input.num_agents = instance.num_agents();
  if (random.percent(20)) {
    input.num_agents = random.below(input.num_agents + 1);
    input.options = input.options + Words{"--agents", std::to_string(input.num_agents)};
  }
  return input;
}

Input generated(Random& random, Workshop& workshop, FileNames& names) {
  Input input;
  const std::string file = names.next(".json");
  input.num_agents = random.between(1, 3);
  input.has_heights = random.percent(30);
  Words words = {"generate",
                 "--kind",
                 "roadmap",
                 "--width",
                 "5",
                 "--height",
                 "5",
                 "--vertices",
                 "8",
                 "--agents",
                 std::to_string(input.num_agents),
                 "--seed",
                 std::to_string(random.below(1000)),
                 "--instance-output",
                 file};
  if (input.has_heights) words = words + Words{"--altitude", "2"};
  if (random.percent(50)) words.emplace_back("--mixed");
  if (random.percent(30)) words = words + Words{"--speed", "1.4", "--radius", "0.2"};
  if (random.percent(50)) words = words + Words{"--resolution", "0.001"};
  QUADRILLE_REQUIRE(workshop.run(words).code == 0, "a roadmap is made");
  input.options = {"--instance", file};
  return input;
}

/// What all agents of a task have in common.
void add_numbers(Random& random, bool on_grid, Input& input) {
  const auto add = [&](const char* option, const std::string& value) {
    input.options = input.options + Words{option, value};
  };
  if (random.percent(60)) add("--radius", random.percent(50) ? "0.2" : "0.34999");
  if (random.percent(30)) add("--speed", random.percent(50) ? "0.7" : "3");
  if (random.percent(50)) add("--resolution", random.percent(50) ? "0.001" : "0.03");
  if (on_grid && random.percent(50)) add("--neighbourhood", std::to_string(random.between(2, 5)));
}

/// A task, as XML: by vertex number, or on a grid of this width by cell, too.
std::string task_text(Random& random, const std::vector<std::size_t>& places, std::size_t agents,
                      std::size_t width) {
  std::string text = "<root>\n";
  std::vector<std::size_t> starts = places, goals = places;
  random.shuffle(starts);
  random.shuffle(goals);
  const bool by_cell = width > 0 && random.percent(50);
  const auto place = [&](const std::string& end, std::size_t v) {
    if (!by_cell) return " " + end + "_id=\"" + std::to_string(v) + "\"";
    return " " + end + "_i=\"" + std::to_string(v / width) + "\" " + end + "_j=\"" +
           std::to_string(v % width) + "\"";
  };
  for (std::size_t i = 0; i < agents; ++i)
    text += "  <agent" + place("start", starts[i]) + place("goal", goals[i]) + "/>\n";
  return text + "</root>\n";
}

Input graphml(Random& random, FileNames& names) {
  const std::size_t n = random.between(2, 6);
  std::string text =
      "<graphml>\n<key id=\"c\" for=\"node\" attr.name=\"coords\"/>\n"
      "<graph edgedefault=\"directed\">\n";
  std::vector<std::size_t> places;
  for (std::size_t v = 0; v < n; ++v) {
    places.push_back(v);
    text +=
        "<node id=\"n" + std::to_string(v) + "\"><data key=\"c\">" +
        number_text(2.5 * static_cast<double>(v % 3)) + "," +
        number_text(0.1 * static_cast<double>(random.below(10)) - 2 * static_cast<double>(v / 3)) +
        "</data></node>\n";
  }
  for (std::size_t v = 1; v < n; ++v)
    text += "<edge directed=\"false\" source=\"n" + std::to_string(random.below(v)) +
            "\" target=\"n" + std::to_string(v) + "\"/>\n";
  Input input;
  const std::string map = names.next(".xml"), task = names.next(".xml");
  write_file(map, text + "</graph>\n</graphml>\n");
  input.num_agents = random.between(1, std::min<std::size_t>(n, 3));
  write_file(task, task_text(random, places, input.num_agents, 0));
  input.options = {"--roadmap", map, "--task", task};
  add_numbers(random, false, input);
  return input;
}

/// Cells, as XML or as a map of MovingAI's.
Input cells(Random& random, FileNames& names) {
  const std::size_t width = random.between(2, 4), height = random.between(1, 3);
  const bool is_xml = random.percent(50);
  std::string rows;
  std::vector<std::size_t> places;
  for (std::size_t v = 0; v < width * height; ++v) {
    const bool free = v == 0 || !random.percent(15);
    if (free) places.push_back(v);
    if (is_xml)
      rows += (v % width == 0 ? "<row>" : " ") + std::string(free ? "0" : "1");
    else
      rows += free ? '.' : '@';
    if (v % width + 1 == width) rows += is_xml ? "</row>\n" : "\n";
  }
  const std::string w = std::to_string(width), h = std::to_string(height);
  const std::string map = names.next(is_xml ? ".xml" : ".map");
  write_file(map, is_xml ? "<root><map><width>" + w + "</width><height>" + h + "</height><grid>" +
                               rows + "</grid></map></root>\n"
                         : "type octile\nheight " + h + "\nwidth " + w + "\nmap\n" + rows);
  const std::string task = names.next(".xml");
  Input input;
  input.num_agents = random.between(1, std::min<std::size_t>(places.size(), 3));
  write_file(task, task_text(random, places, input.num_agents, width));
  input.options = {"--roadmap", map, "--task", task};
  add_numbers(random, true, input);
  return input;
}

}  // namespace

Input draw_roadmap(Random& random, Workshop& workshop, FileNames& names) {
  Input input = [&] {
    switch (random.below(6)) {
      case 0:
        return generated(random, workshop, names);
      case 1:
        return graphml(random, names);
      case 2:
        return cells(random, names);
      default:
        return one_file(random, names);
    }
  }();
  input.in_time = true;
  input.has_cells = false;
  return input;
}

double draw_resolution(Random& random) {
  const std::vector<double> sizes = {1e-9, 1e-6,    0.001, 0.01,     0.05, 0.1, 0.25, 0.3,
                                     1,    1.0 / 3, 7,     1.0 / 17, 1000, 2e5, 0.07};
  return random.pick(sizes);
}

std::string number_text(double number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

}  // namespace quadrille::cli::test
