// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "answers/history.hpp"
#include "frame/output.hpp"
#include "quadrille/core/reasons.hpp"

namespace quadrille::cli {

/// What is told of a search beside its outcome, if that was asked for.
struct SearchNotes {
  History history;
  std::vector<Reason> reasons;  ///< Of the outcome's attribution.
  Json second_opinion;          ///< Null if none was asked for.
  std::string opinion;          ///< The same for people; empty if none was asked for.
};

}  // namespace quadrille::cli
