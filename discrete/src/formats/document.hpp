// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "quadrille/text/document.hpp"

namespace quadrille::discrete {

using text::Checker;
using text::Document;
using text::DocumentBuilder;
using text::parse_json;

/// One YAML document without anchors, aliases and tags other than `!!python/tuple`. Plain scalars
/// that look like decimal integers are integers, null ones are null, all others are strings.
/// Errors as those of parse_json.
[[nodiscard]] Result<Document> parse_yaml(const std::string& text, const std::string& file);

}  // namespace quadrille::discrete
