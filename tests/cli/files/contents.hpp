// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace quadrille::cli::test {

// What is wrong with the text of a file for other programs; empty if nothing is.

/// JSON, which is UTF-8.
[[nodiscard]] std::string why_no_json(const std::string& text);
/// XML, with characters that XML has.
[[nodiscard]] std::string why_no_xml(const std::string& text);
/// A page of the viewer: characters that HTML has, and the data of its script.
[[nodiscard]] std::string why_no_page(const std::string& text);
/// Lines with as many numbers each as the first one has words.
[[nodiscard]] std::string why_no_table(const std::string& text);

/// Of the plan in this project's JSON, in either domain, without what agents do not do any more.
[[nodiscard]] nlohmann::json plan_in(const std::string& text);

}  // namespace quadrille::cli::test
