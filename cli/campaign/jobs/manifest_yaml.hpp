// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// What is wrong with a manifest; leaves the reader, never the room.
struct Refused {
  Error error;
};

/// Strict access to the nodes of a YAML file: whatever is not expected is refused (throws Refused)
/// with its line.
class YamlAccess {
 public:
  explicit YamlAccess(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& message) const;
  [[noreturn]] void refuse(long line, const std::string& message) const;
  [[nodiscard]] static long line(const YAML::Node& node) {
    return node.Mark().is_null() ? 0 : node.Mark().line + 1;
  }

  struct Member {
    const char* key;
    std::function<void(const YAML::Node&)> read;
  };
  /// A map whose keys are among these, each once; reads them in the order of the file.
  void members(const YAML::Node& map, const std::string& what,
               std::initializer_list<Member> known) const;

  [[nodiscard]] std::string text(const YAML::Node& node, const std::string& what) const;
  [[nodiscard]] std::int64_t natural(const YAML::Node& node, const std::string& what,
                                     std::int64_t least, std::int64_t most) const;
  /// A finite number above `above`.
  [[nodiscard]] double number(const YAML::Node& node, const std::string& what, double above) const;
  /// A list of words, or a text whose words are separated by blanks.
  [[nodiscard]] std::vector<std::string> words(const YAML::Node& node,
                                               const std::string& what) const;

 private:
  std::string file_;
};

}  // namespace quadrille::cli::campaign
