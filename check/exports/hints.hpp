// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <vector>

#include "read/basics.hpp"

namespace quadrille_check {

/// A hint that unit propagation uses: it implies a literal, or is false (0).
struct UsedHint {
  Int clause = 0, implied = 0;
};
/// For checkers that do not pass over useless hints: those that are used, up to the one that is
/// false. `literals`: of all clauses. Empty if none is false.
[[nodiscard]] std::vector<UsedHint> used_hints(const Ints& clause, const Ints& hints,
                                               const std::map<Int, Ints>& literals);

}  // namespace quadrille_check
