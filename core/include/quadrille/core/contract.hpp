// SPDX-License-Identifier: MIT
#pragma once

namespace quadrille::detail {
/// Writes the broken contract to stderr and aborts: a caller's bug is not an outcome.
[[noreturn]] void contract_failed(const char* condition, const char* file, int line,
                                  const char* explanation) noexcept;
}  // namespace quadrille::detail

/// States what the caller owes. Checked in every build type; for bad *input* use Result instead.
#define QUADRILLE_REQUIRE(condition, explanation) \
  (static_cast<bool>(condition)                   \
       ? static_cast<void>(0)                     \
       : ::quadrille::detail::contract_failed(#condition, __FILE__, __LINE__, explanation))
