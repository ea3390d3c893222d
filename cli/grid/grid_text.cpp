// SPDX-License-Identifier: MIT
#include "grid/grid_text.hpp"

#include <fmt/format.h>

namespace quadrille::cli {

std::string describe_graph(const discrete::Graph& graph) {
  const std::string shape = graph.layout() ? fmt::format("{} x {} grid", graph.layout()->width(),
                                                         graph.layout()->height())
                                           : "graph";
  return fmt::format("{}, {} vertices, {} edges", shape, graph.num_vertices(), graph.num_edges());
}

std::string describe_letters(const std::vector<discrete::LetterCount>& letters) {
  std::string text;
  for (const discrete::LetterCount& letter : letters)
    text += fmt::format("letters    {} cells '{}' read as {}\n", letter.cells, letter.letter,
                        letter.passable ? "passable" : "blocked");
  return text;
}

std::string describe_input(const input::GridInput& input) {
  std::string text =
      fmt::format("map        {}: {}\n", input.source, describe_graph(input.instance.graph()));
  text += describe_letters(input.other_letters);
  if (input.task_source.empty()) return text;
  text += fmt::format("agents     {} from {}", input.instance.num_agents(), input.task_source);
  if (input.rows > 0) text += fmt::format(" (of {} rows)", input.rows);
  text += "\n";
  if (!input.other_map.empty())
    text += fmt::format("note       the scenario names another map, {}\n", input.other_map);
  if (!input.note.empty()) text += "note       " + input.note + "\n";
  return text;
}

}  // namespace quadrille::cli
