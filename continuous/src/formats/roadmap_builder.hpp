// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "quadrille/continuous/map_file.hpp"
#include "quadrille/core/result.hpp"

namespace quadrille::continuous {

/// Makes a roadmap of what the readers of all formats find, one vertex and one edge after the
/// other. What is wrong comes back without a place, which the reader knows.
class RoadmapBuilder {
 public:
  struct Fault {
    ErrorCode code;
    std::string message;
  };

  explicit RoadmapBuilder(const MapFileOptions& options) : options_(options) {}

  [[nodiscard]] std::size_t num_vertices() const noexcept { return positions_.size(); }

  /// The next vertex, of which `id` is the only one. Coordinates in the input's unit of length.
  std::optional<Fault> add_vertex(std::string id, const std::array<double, 3>& at);
  [[nodiscard]] std::optional<VertexId> find(const std::string& id) const;
  /// What a vertex was called when it was added.
  [[nodiscard]] const std::string& id(VertexId vertex) const { return ids_[vertex.index()]; }
  /// From one vertex to another, in radians, 0 along x; 0 in one place.
  [[nodiscard]] double direction(VertexId from, VertexId to) const;
  /// From the vertex with the one id to that with the other; a limit of 0 is none.
  std::optional<Fault> add_edge(const std::string& from, const std::string& to,
                                std::optional<double> speed_limit = std::nullopt);
  std::optional<Fault> add_edge(VertexId from, VertexId to,
                                std::optional<double> speed_limit = std::nullopt);
  /// Nobody may wait there. Once per vertex.
  void forbid_waiting(VertexId vertex) { no_waiting_.push_back(vertex); }
  /// What the file says of headings.
  [[nodiscard]] HeadingRules& headings() noexcept { return headings_; }
  /// Something more that a vertex is called.
  void add_place(std::string name, VertexId vertex);
  /// Something that the file says and that plans do not honour; it is counted.
  void not_used(std::string_view what) { ++not_used_[std::string(what)]; }
  void note(std::string text) { notes_.push_back(std::move(text)); }

  /// The roadmap. Ids that are 0, 1, ... in any order, with or without an n in front of all of
  /// them, are the numbers of the vertices; with others vertices are numbered in the order of the
  /// file.
  [[nodiscard]] Result<MapFile> finish(const std::string& file) &&;

 private:
  /// By vertex its number, if the ids are numbers.
  [[nodiscard]] std::optional<std::vector<std::size_t>> numbers() const;
  void renumber(const std::vector<std::size_t>& number_of);

  const MapFileOptions& options_;
  std::vector<Point> positions_;
  std::vector<Edge> edges_;
  std::vector<VertexId> no_waiting_;
  HeadingRules headings_;
  std::vector<std::string> ids_;
  std::unordered_map<std::string, VertexId> by_id_;  // Looked up only.
  std::vector<std::pair<std::string, VertexId>> places_;
  std::map<std::string, std::size_t> not_used_;
  std::vector<std::string> notes_;
  std::size_t num_zero_length_edges_ = 0;
};

}  // namespace quadrille::continuous
