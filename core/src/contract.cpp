// SPDX-License-Identifier: MIT
#include "quadrille/core/contract.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace quadrille {
namespace {

void report(const ContractViolation& violation) {
  std::fprintf(stderr, "quadrille: contract broken at %s:%d: %s (%s)\n", violation.file,
               violation.line, violation.explanation, violation.condition);
}

std::atomic<ContractHandler> current_handler = nullptr;

}  // namespace

ContractHandler set_contract_handler(ContractHandler handler) noexcept {
  return current_handler.exchange(handler);
}

void detail::contract_failed(const char* condition, const char* file, int line,
                             const char* explanation) {
  const ContractHandler handler = current_handler.load();
  (handler != nullptr ? handler : report)({condition, explanation, file, line});
  std::abort();
}

}  // namespace quadrille
