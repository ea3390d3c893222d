// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/text/document.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// What whoever made an instance calls its parts; searches know numbers only. Readers of instances
/// give it and writers take it, so that no name is lost on the way through a file.
struct Names {
  /// Of agents 0, 1, ...; none of those that are missing at the end.
  std::vector<std::optional<std::string>> agents;
  /// Of the vertices 0, 1, ... of a roadmap, none of the rest. Each as JSON on one line: a string,
  /// a whole number, or a list of such.
  std::vector<std::string> vertices;
  /// Of the groups 0, 1, ... of agents on a roadmap; as for agents.
  std::vector<std::optional<std::string>> groups;

  /// The name of an agent, or null.
  [[nodiscard]] const std::string* agent(std::size_t number) const {
    return number < agents.size() && agents[number] ? &*agents[number] : nullptr;
  }
  friend bool operator==(const Names&, const Names&) = default;
};

/// `text` in double quotes as JSON has it, which is also YAML: quotes, backslashes and control
/// characters escaped, all else as it is.
[[nodiscard]] std::string quoted_json(std::string_view text);

// Readers; like those of Checker they return whether all is well.

/// A text in UTF-8, or a whole number.
bool read_name(Checker& check, const Document& document, Document::Node node,
               std::optional<std::string>& name);
/// A list of such, and null where there is none.
bool read_names(Checker& check, const Document& document, Document::Node list,
                std::vector<std::optional<std::string>>& names);
/// The names of vertices, at most `most` of them, which differ.
bool read_vertex_names(Checker& check, const Document& document, Document::Node list,
                       std::size_t most, std::vector<std::string>& names);
/// Whether no two agents are called alike; those without a name are called by their numbers.
/// `places`: of the agents in the document.
bool are_distinct(Checker& check, const std::vector<std::optional<std::string>>& agents,
                  const std::vector<Document::Node>& places);

}  // namespace quadrille::text

QUADRILLE_API_END
