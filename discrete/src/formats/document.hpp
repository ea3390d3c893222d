// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "quadrille/text/document.hpp"

namespace quadrille::discrete {

using text::Checker;
using text::Document;
using text::DocumentBuilder;
using text::parse_json;

/// A value, key or comment, and a flow collection in a place where it could be a key (above all one
/// that is the whole document), has at most this many bytes.
inline constexpr std::size_t kMaxYamlLookahead = std::size_t{1} << 20;

/// One YAML document without anchors, aliases and tags other than `!!python/tuple`. Plain scalars
/// that look like decimal integers are integers, null ones are null, all others are strings.
/// Errors as those of parse_json, and out_of_range above kMaxYamlLookahead.
[[nodiscard]] Result<Document> parse_yaml(const std::string& text, const std::string& file);

}  // namespace quadrille::discrete
