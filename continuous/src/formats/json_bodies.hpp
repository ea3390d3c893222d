// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/text/document.hpp"

// What agents and obstacles look like in instances as JSON.
namespace quadrille::continuous {

/// All return false after an error. What is given outlives this, and the resolution is read first.
class BodyReader {
 public:
  using Node = text::Document::Node;
  BodyReader(const text::Document& document, text::Checker& check, const Resolution& resolution)
      : document_(document), check_(check), resolution_(resolution) {}

  /// The list "bodies" of an instance: of lists, one body by shape.
  bool read_list(Node list);
  /// Which of these keys the object has, if any.
  struct Keys {
    std::optional<Node> radius, polygon;
    std::optional<Node> body = {};  ///< A number in the list.
  };
  bool read(Node object, const Keys& keys, Body& body);
  bool read(Node object, const Keys& keys, Agent& agent);

 private:
  bool read_polygon(Node node, Body& body);
  bool read_corner(Node node, Length& length);
  bool read_radius(Node node, Length& radius);

  const text::Document& document_;
  text::Checker& check_;
  const Resolution& resolution_;
  std::vector<std::vector<Body>> bodies_;
};

/// "radius": .., or "polygon": ..
[[nodiscard]] std::string body_json(const Body& body, const Resolution& resolution);

/// The different ones that agents with shapes have.
class BodyList {
 public:
  explicit BodyList(const Instance& instance);
  /// The member of an agent that says what it looks like.
  [[nodiscard]] std::string member(AgentId agent) const;
  /// The member of the instance; empty if nobody has shapes.
  [[nodiscard]] std::string json() const;

 private:
  const Instance& instance_;
  std::map<ClassId, std::size_t> numbers_;
  std::vector<ClassId> classes_;  // of the list
};

}  // namespace quadrille::continuous
