// SPDX-License-Identifier: MIT
#include "quadrille/input/source.hpp"

#include <fstream>
#include <utility>

#include "quadrille/text/text_input.hpp"

namespace quadrille::input {
std::optional<Error> check_agents(const InputOptions& options, std::size_t agents) {
  if (!options.agents || static_cast<std::size_t>(*options.agents) <= agents) return std::nullopt;
  return Error{ErrorCode::invalid_instance,
               "there are only " + std::to_string(agents) + " agents, not " +
                   std::to_string(*options.agents),
               {options.instance, 0}};
}

std::optional<Error> check_map_size(const InputOptions& options, std::int64_t cells,
                                    const std::string& file) {
  if (static_cast<std::size_t>(cells) <= options.most_vertices) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "the map has " + std::to_string(cells) + " passable cells, more than " +
                   std::to_string(options.most_vertices) +
                   ", which are the most that can be solved: take a coarser map, or a part of it",
               {file, 0}};
}

Error with_letters_hint(Error error) {
  if (error.message.find("is neither known as passable nor as blocked") != std::string::npos)
    error.message += " (--passable and --blocked say what it is)";
  return error;
}

Result<std::string> read_text(const std::string& file) {
  std::ifstream in;
  if (auto error = text::open_input(file, in)) return *error;
  return text::read_all(in, file);
}

}  // namespace quadrille::input
