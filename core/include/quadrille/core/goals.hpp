// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Where an agent may end: at any one vertex of a set. Most sets have one vertex, and such a vertex
/// converts into its set. Immutable; cheap to copy, because larger sets are shared.
class Goals {
 public:
  Goals() = default;                         ///< The set of vertex 0, as VertexId().
  Goals(VertexId vertex) : only_(vertex) {}  // NOLINT(google-explicit-constructor)
  /// In any order; what is there twice counts once. A set may be empty, but instances refuse that.
  explicit Goals(std::vector<VertexId> vertices) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (vertices.size() == 1)
      only_ = vertices.front();
    else
      several_ = std::make_shared<const std::vector<VertexId>>(std::move(vertices));
  }

  /// Increasing. Valid as long as this object.
  [[nodiscard]] std::span<const VertexId> vertices() const noexcept {
    return several_ ? std::span<const VertexId>(*several_) : std::span<const VertexId>(&only_, 1);
  }
  [[nodiscard]] std::size_t size() const noexcept { return several_ ? several_->size() : 1; }
  [[nodiscard]] bool is_single() const noexcept { return several_ == nullptr; }
  /// O(log size).
  [[nodiscard]] bool contains(VertexId vertex) const {
    if (!several_) return vertex == only_;
    return std::binary_search(several_->begin(), several_->end(), vertex);
  }
  /// Requires that there is one vertex only.
  [[nodiscard]] VertexId only() const {
    QUADRILLE_REQUIRE(is_single(), "one goal, not a set of several");
    return only_;
  }

  friend bool operator==(const Goals& a, const Goals& b) {
    return std::ranges::equal(a.vertices(), b.vertices());
  }

 private:
  VertexId only_;
  std::shared_ptr<const std::vector<VertexId>> several_;  // Null: only_. Never one vertex.
};

}  // namespace quadrille

QUADRILLE_API_END
