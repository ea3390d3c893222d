// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "cover/core_table.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/solve/answers.hpp"
#include "solve/lemma_stock.hpp"
#include "traffic/scene_store.hpp"

namespace quadrille::continuous {

using solve::GroupBound;

/// What a search by clauses has learned.
struct Learned {
  LemmaStock lemmas;             ///< All hold, up to what is doubtful.
  std::vector<LevelCore> cores;  ///< Nothing follows from them: they are tried first.
};

/// What earlier solves on the same roadmap leave to one.
struct WarmStart {
  SceneStore* store = nullptr;  ///< Null, or one that has adopted the instance.
  std::vector<GroupBound> bounds;
  /// Paths of some of the agents, which obey all rules and do not collide; empty for the others.
  std::vector<IdVector<AgentId, Path>> drafts;
  Learned learned = {};
  /// Unless null: where a search by clauses leaves what it has learned, with what of `learned` it
  /// has taken up. Not touched if there is none, or if callbacks throw.
  std::optional<Learned>* learned_after = nullptr;
};

/// A solve of an instance that begins at 0; see solve::search_from_0.
using SearchFrom0 = std::function<Result<SolveOutcome>(const Instance&, const SolveOptions&)>;
/// The border between the times of users and those of searches.
[[nodiscard]] Result<SolveOutcome> search_from_0(const Instance& instance,
                                                 const SolveOptions& options,
                                                 const SearchFrom0& search);

/// As continuous::solve, with what is known already. Requires that the instance begins at 0.
[[nodiscard]] Result<SolveOutcome> solve_from_0(const Instance& instance,
                                                const SolveOptions& options, const WarmStart& warm);

}  // namespace quadrille::continuous
