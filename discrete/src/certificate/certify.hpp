// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "quadrille/discrete/feasibility.hpp"
#include "quadrille/discrete/instance.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/sat/certificate.hpp"

namespace quadrille::discrete {

/// What a search leaves of its proof.
struct ProofDraft {
  std::optional<sat::TrimmedProof> proof;  ///< Absent: the search did not come so far.
  std::string fault;                       ///< An error of the program; empty if there was none.
};

/// A certificate for the proof's claim, with the plan if there is one.
[[nodiscard]] Certificate certify(const Instance& instance, Objective objective,
                                  const sat::TrimmedProof& proof, const std::optional<Plan>& plan);
/// A certificate that there is no plan.
[[nodiscard]] Certificate certify_infeasible(const Instance& instance, Objective objective,
                                             const Invariant& invariant);
/// A proof that rests on nothing but what agents cost at least when each is alone, which is `bound`
/// or more.
[[nodiscard]] sat::TrimmedProof free_proof(Cost bound);

}  // namespace quadrille::discrete
