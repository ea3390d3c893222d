// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// Text as a terminal may get it, whoever wrote it: control characters (C0 but tab and newline,
/// DEL, C1), the separators U+2028 and U+2029, and characters that change the direction of writing
/// (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069) become `\u` and four hexadecimal
/// digits; bytes that are no UTF-8 become `\x` and two. All else stays as it is, so that a second
/// call changes nothing, and JSON stays JSON. O(length).
[[nodiscard]] std::string terminal_text(std::string_view text);
/// The same for one line: newlines become `\n`. Error::to_string gives its text through this.
[[nodiscard]] std::string terminal_line(std::string_view text);

}  // namespace quadrille

QUADRILLE_API_END
