// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "rules/checker.hpp"

namespace quadrille_check {

/// Writes the propositional part of a certificate that was verified: a formula in DIMACS, that all
/// axioms are true and yet a clause that the bound rests on is not, and its refutation in LRAT.
/// False if a file cannot be written. What remains for this program alone is that the axioms are
/// true of plans, and what the clauses come to in sum.
[[nodiscard]] bool export_lrat(const std::string& content, const std::string& cnf,
                               const std::string& lrat);

/// Likewise with what the clauses come to in sum: a pseudo-Boolean formula in OPB, that all axioms
/// are true and yet the cost is less than claimed, and its refutation for VeriPB. What remains for
/// this program alone is that the axioms are true of plans. `checker` has verified the certificate.
/// Throws BadInput if that would take more than some 10^7 variables.
[[nodiscard]] bool export_pb(const std::string& content, const Checker& checker,
                             const std::string& opb, const std::string& pbp);

}  // namespace quadrille_check
