// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "quadrille/core/result.hpp"

namespace quadrille::cli::campaign {

/// The files that a pattern of the shell matches, by the bytes of their names. Errors (io): a
/// folder that cannot be read; none matches.
[[nodiscard]] Result<std::vector<std::string>> matching_files(const std::string& pattern);

/// Puts values in the place of {names}, so that they match themselves only.
[[nodiscard]] std::string substitute(std::string pattern, const std::string& name,
                                     const std::string& value);

}  // namespace quadrille::cli::campaign
