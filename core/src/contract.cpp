// SPDX-License-Identifier: MIT
#include "quadrille/core/contract.hpp"

#include <cstdio>
#include <cstdlib>

namespace quadrille::detail {

void contract_failed(const char* condition, const char* file, int line,
                     const char* explanation) noexcept {
  std::fprintf(stderr, "quadrille: contract broken at %s:%d: %s (%s)\n", file, line, explanation,
               condition);
  std::abort();
}

}  // namespace quadrille::detail
