// SPDX-License-Identifier: MIT
#include "quadrille/core/result.hpp"

#include "quadrille/core/terminal_text.hpp"

namespace quadrille {

std::string Error::to_string() const {
  std::string text;
  if (!where.file.empty()) {
    text += where.file;
    if (where.line > 0) {
      text += ':';
      text += std::to_string(where.line);
    }
    text += ": ";
  }
  return terminal_line(text + message);
}

}  // namespace quadrille
