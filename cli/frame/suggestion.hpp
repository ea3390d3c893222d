// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frame/option_parser.hpp"

namespace quadrille::cli {

/// How many letters have to be inserted, removed, replaced or swapped with their neighbour to make
/// one word of the other (optimal string alignment; Wagner and Fischer's table). O(a b).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word that was probably meant: the first one of least distance, if that is at most a third of
/// the letters that were written; else empty.
[[nodiscard]] std::string closest(std::string_view written, const std::vector<std::string>& words);

/// What is wrong with a command line that has `written` where nothing of it was expected, with a
/// guess at the option or the subcommand of `app` that was meant.
[[nodiscard]] std::string describe_unexpected(const CLI::App& app, const std::string& written);

}  // namespace quadrille::cli
