// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cover/level_cover.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/continuous/solver.hpp"
#include "quadrille/sat/engine.hpp"
#include "theory/model.hpp"

namespace quadrille::continuous {

/// What a search leaves of its proof: the records of a certificate without head and claim.
struct ProofDraft {
  /// No plan costs less, of those that are cheaper than all that the search knew.
  Cost bound = 0;
  std::string records;
  std::int64_t clause = 0;  ///< That the claim rests on; 0: on trees.
  /// There is no plan that is cheaper than all that the search knew: the clause is empty.
  bool is_exhausted = false;
  std::string fault;  ///< An error of the program; empty if there was none.
};

/// Of a search with this engine, whose log has all that it did. `covers`: what its bound rests on,
/// for the sum of costs. `free_bound`: what plans cost at least when each agent is alone.
[[nodiscard]] ProofDraft draft_proof(Model& model, const sat::Engine& engine,
                                     std::span<const ProvedCover> covers, Objective objective,
                                     Cost free_bound);

/// Where no search was needed, or none began: what agents cost when each is alone is `bound` or
/// more.
[[nodiscard]] ProofDraft draft_without_search(const Instance& instance, Cost bound);

/// A certificate of the draft's claim, with the plan if there is one.
[[nodiscard]] Certificate certify(const Instance& instance, Objective objective,
                                  const ProofDraft& draft, const std::optional<Plan>& plan);

/// Which of all that is in the instance certificates know no rule for; empty: they know all.
[[nodiscard]] std::string why_no_certificate(const Instance& instance);

}  // namespace quadrille::continuous
