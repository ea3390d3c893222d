// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "quadrille/core/export.hpp"
#include "quadrille/text/document.hpp"
#include "quadrille/text/text_input.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::text {

/// Reads one of two words: `yes` makes `choice` true. Otherwise the checker has an error.
inline bool read_choice(Checker& check, Document::Node node, const std::string& no,
                        const std::string& yes, bool& choice) {
  std::string_view what;
  if (!check.text(node, what)) return false;
  choice = what == yes;
  if (choice || what == no) return true;
  return check.fail(node, "expected '" + no + "' or '" + yes + "', found " + in_quotes(what));
}

}  // namespace quadrille::text

QUADRILLE_API_END
