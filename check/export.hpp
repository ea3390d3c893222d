// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace quadrille_check {

/// Writes the propositional part of a certificate that was verified: a formula in DIMACS, that all
/// axioms are true and yet a clause that the bound rests on is not, and its refutation in LRAT.
/// False if a file cannot be written. What remains for this program alone is that the axioms are
/// true of plans, and what the clauses come to in sum.
[[nodiscard]] bool export_lrat(const std::string& content, const std::string& cnf,
                               const std::string& lrat);

}  // namespace quadrille_check
