// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "formats/roadmap_builder.hpp"
#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/open_objects.hpp"

namespace quadrille::continuous {

/// What a LIF says of orientations and rotations, for one type of vehicles. Where nobody asks for
/// headings all of it is counted as not used. Functions say whether all is well.
class LifHeadings {
 public:
  using Node = text::Document::Node;
  /// The fields of an edge that are there.
  struct Edge {
    std::optional<Node> orientation, type, on_edge, at_start, at_end, most;
  };

  /// All outlive it.
  LifHeadings(text::Checker& check, const MapFileOptions& options, RoadmapBuilder& builder)
      : check_(check), options_(options), builder_(builder) {}

  /// Whoever is at the vertex faces there.
  bool add_stand(Node theta, VertexId vertex);
  /// Of an edge that the builder has.
  bool add_edge(const Edge& edge, VertexId from, VertexId to);
  /// When all edges are read: what there is to be said.
  void finish();

 private:
  bool read_heading(const Edge& edge, VertexId from, VertexId to);
  bool read_turns(const Edge& edge, VertexId from, VertexId to);
  bool read_directions(const std::optional<Node>& node, HeadingRules::Turns& turns);
  void count_unused(const Edge& edge);

  text::Checker& check_;
  const MapFileOptions& options_;
  RoadmapBuilder& builder_;
  std::size_t num_ahead_ = 0;  // edges without an orientation
  /// By vertex which sets of directions edges allow there.
  std::map<VertexId, std::set<std::pair<bool, bool>>> allowed_;
};

}  // namespace quadrille::continuous
