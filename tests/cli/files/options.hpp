// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cli/files/inputs.hpp"

namespace quadrille::cli::test {

/// What a solve is asked to write; empty where nothing is.
struct Outputs {
  std::string plan, json, view, svg;
};

/// Options of `solve` about the search: any that go together.
[[nodiscard]] Words draw_search(Random& random, const Input& input, bool has_json);
/// Options of `solve` about its outputs, whose names are in `outputs`. At least one of plan and
/// result is among them.
[[nodiscard]] Words draw_outputs(Random& random, const Input& input, FileNames& names,
                                 Outputs& outputs);
/// Plan formats that can express plans of such an input.
[[nodiscard]] std::vector<std::string> plan_formats(const Input& input);
/// Options about a picture, without the file.
[[nodiscard]] Words draw_picture(Random& random, const Input& input);

}  // namespace quadrille::cli::test
