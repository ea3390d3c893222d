// SPDX-License-Identifier: MIT
#pragma once

#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

namespace quadrille {

/// What a caller owed and did not do.
struct ContractViolation {
  const char* condition;  ///< The expression that is false, as in the source.
  const char* explanation;
  const char* file;  ///< Where it is checked.
  int line;
};

/// Is told of a broken contract. When it returns, the program is aborted. It may throw instead; the
/// objects involved are then good for nothing but destruction, and a function that is noexcept
/// ends the program.
using ContractHandler = void (*)(const ContractViolation& violation);

/// Sets the handler of the whole process and returns the one before it; nullptr is the default,
/// which writes the violation to stderr. Safe to call at any time, from any thread.
ContractHandler set_contract_handler(ContractHandler handler) noexcept;

namespace detail {
/// Calls the handler, then aborts: a caller's bug is not an outcome.
[[noreturn]] void contract_failed(const char* condition, const char* file, int line,
                                  const char* explanation);
}  // namespace detail

}  // namespace quadrille

QUADRILLE_API_END

/// States what the caller owes. Checked in every build type; for bad *input* use Result instead.
#define QUADRILLE_REQUIRE(condition, explanation) \
  (static_cast<bool>(condition)                   \
       ? static_cast<void>(0)                     \
       : ::quadrille::detail::contract_failed(#condition, __FILE__, __LINE__, explanation))
