// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "quadrille/continuous/roadmap.hpp"

namespace quadrille::continuous {

/// Which vertices the agents of a group can come to. Takes time linear in the roadmap once; then
/// what lies on a common circuit is known at once, and only ways that lead there alone are
/// searched.
class Reachability {
 public:
  /// `roadmap` outlives the object.
  Reachability(const Roadmap& roadmap, GroupId group);

  [[nodiscard]] bool leads(VertexId from, VertexId to);

 private:
  void search(VertexId root);
  void enter(VertexId v);
  void leave(VertexId v);

  const Roadmap& roadmap_;
  const GroupId group_;
  // By vertex: its strongly connected component. Edges between components lead to lower ones.
  std::vector<std::uint32_t> component_;
  std::uint32_t num_components_ = 0;
  // Of the search for components.
  struct Frame {
    VertexId vertex;
    std::size_t next = 0;  // edge
  };
  std::vector<std::uint32_t> order_, low_;
  std::vector<VertexId> open_;
  std::vector<Frame> frames_;
  std::uint32_t num_entered_ = 0;
  // Of the last search for a way: whose vertices carry its number.
  std::vector<std::uint32_t> seen_;
  std::uint32_t num_searches_ = 0;
};

}  // namespace quadrille::continuous
