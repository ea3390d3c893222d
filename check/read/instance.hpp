// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "read/basics.hpp"
#include "read/json.hpp"

namespace quadrille_check {

/// Agents on a graph. Places are vertices; on a grid the cells, row by row, blocked ones too.
class Instance {
 public:
  struct Agent {
    int start = 0, goal = 0;
  };

  /// Throw BadInput. `passable`: width * height cells.
  static Instance on_grid(int width, int height, const std::vector<bool>& passable);
  static Instance on_graph(int num_vertices, std::vector<std::pair<int, int>> edges);
  void add_agent(Agent agent);

  [[nodiscard]] bool is_grid() const { return width_ > 0; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int num_places() const { return static_cast<int>(exists_.size()); }
  /// Whether agents can be there; false for numbers that are no places.
  [[nodiscard]] bool has(Int place) const {
    return place >= 0 && place < num_places() && exists_[static_cast<std::size_t>(place)];
  }
  [[nodiscard]] std::span<const int> neighbours(int place) const;
  [[nodiscard]] bool are_joined(int a, int b) const;
  /// No walk from a to b is shorter; 0 where nothing better is known without a search.
  [[nodiscard]] int least_distance(int a, int b) const;
  [[nodiscard]] const std::vector<Agent>& agents() const { return agents_; }

  /// Numbers of moves from `from` to all places, kFar where there is no way; around `without`, if
  /// that is a place.
  [[nodiscard]] std::vector<int> distances(int from, int without = -1) const;

 private:
  int width_ = 0, height_ = 0;  // 0: no grid
  std::vector<bool> exists_;
  std::vector<std::size_t> begins_;  // of the neighbours
  std::vector<int> neighbours_;
  std::vector<Agent> agents_;
  std::set<int> starts_, goals_;
};

/// Distances that are asked for again and again. Keeps at most some 256 MB of them.
class Distances {
 public:
  explicit Distances(const Instance& instance);  ///< Which outlives it.
  using Table = std::shared_ptr<const std::vector<int>>;
  [[nodiscard]] Table from(int place, int without = -1);

 private:
  using Key = std::pair<int, int>;
  const Instance& instance_;
  const std::size_t most_;
  std::map<Key, Table> known_;
  std::deque<Key> order_;
};

/// Throw BadInput with the name of the file. `passable` and `blocked`: letters besides "." and "G",
/// "@", "O" and "T".
[[nodiscard]] Instance read_movingai(const std::string& map, const std::string& scen,
                                     int num_agents, const std::string& passable,
                                     const std::string& blocked);
[[nodiscard]] Instance read_json(const std::string& file);
/// Of a file's content.
[[nodiscard]] Instance instance_of(const Json& root, const std::string& file);

/// A file's content. Throws BadInput.
[[nodiscard]] std::string read_file(const std::string& name);

}  // namespace quadrille_check
