// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "session/bound_cache.hpp"
#include "solve/warm_start.hpp"

namespace quadrille::continuous {

/// What the last search by clauses has learned, with what it began with, and what of it is true in
/// another situation on the same roadmap. Why that is so: docs/soundness/sessions.md.
class LemmaStore {
 public:
  /// `base`: of the vertices and edges after those of this roadmap nothing is kept.
  explicit LemmaStore(std::shared_ptr<const Roadmap> base) : base_(std::move(base)) {}

  /// What a search in a situation has left.
  void put(const Situation& situation, Learned learned);

  /// For a solve of `now`.
  [[nodiscard]] Learned learned(const Situation& now) const;

 private:
  std::shared_ptr<const Roadmap> base_;
  Situation situation_;
  Learned learned_;
};

}  // namespace quadrille::continuous
