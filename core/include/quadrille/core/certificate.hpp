// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// That no plan costs less than `claim`, or that there is none, in a form that the program
/// quadrille-check checks; with the plan, if there is one. docs/certificates.md.
struct Certificate {
  std::optional<Cost> claim;  ///< Absent: there is no plan.
  std::string bytes;          ///< A file's content, binary.
};

/// What a solve that was asked for a certificate answers besides.
struct CertifiedOutcome {
  /// Its claim is the lower bound, or less where that rests on `known_lower_bound`, or where memory
  /// ran out in the search.
  std::optional<Certificate> certificate;
  /// Why there is none. Else empty.
  std::string no_certificate;
};

}  // namespace quadrille

QUADRILLE_API_END
