// SPDX-License-Identifier: MIT
#include "quadrille/sat/lemma.hpp"

namespace quadrille::sat {

std::string_view to_string(LemmaKind kind) noexcept {
  switch (kind) {
    case LemmaKind::path:
      return "path";
    case LemmaKind::collision:
      return "collision";
    case LemmaKind::order:
      return "order";
    case LemmaKind::counting:
      return "counting";
    case LemmaKind::core:
      return "core";
  }
  return "?";
}

}  // namespace quadrille::sat
