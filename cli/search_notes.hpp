// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "history.hpp"
#include "quadrille/core/reasons.hpp"

namespace quadrille::cli {

/// What is told of a search beside its outcome, if that was asked for.
struct SearchNotes {
  History history;
  std::vector<Reason> reasons;  ///< Of the outcome's attribution.
};

}  // namespace quadrille::cli
