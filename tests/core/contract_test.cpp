// SPDX-License-Identifier: MIT
#include "quadrille/core/contract.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "quadrille/core/ids.hpp"

namespace quadrille {
namespace {

struct Broken : std::runtime_error {
  using runtime_error::runtime_error;
};

[[noreturn]] void throw_broken(const ContractViolation& violation) {
  throw Broken(std::string(violation.explanation) + " | " + violation.condition);
}

/// Puts the handler back that was there before.
class ScopedHandler {
 public:
  explicit ScopedHandler(ContractHandler handler) : before_(set_contract_handler(handler)) {}
  ~ScopedHandler() { set_contract_handler(before_); }
  ScopedHandler(const ScopedHandler&) = delete;
  ScopedHandler& operator=(const ScopedHandler&) = delete;

 private:
  ContractHandler before_;
};

TEST(Contract, IsReportedAndAbortsByDefault) {
  EXPECT_DEATH(QUADRILLE_REQUIRE(1 > 2, "one is less"),
               "contract broken at .*contract_test.cpp:[0-9]+: one is less \\(1 > 2\\)");
  QUADRILLE_REQUIRE(2 > 1, "fine");
}

TEST(Contract, AHostMayTakeItOver) {
  const ScopedHandler scoped(throw_broken);
  try {
    QUADRILLE_REQUIRE(1 > 2, "one is less");
    FAIL();
  } catch (const Broken& broken) {
    EXPECT_STREQ(broken.what(), "one is less | 1 > 2");
  }
  EXPECT_EQ(set_contract_handler(throw_broken), throw_broken);
}

TEST(Contract, AHandlerThatReturnsDoesNotSaveTheProgram) {
  const ScopedHandler scoped([](const ContractViolation&) {});
  EXPECT_DEATH(QUADRILLE_REQUIRE(1 > 2, "one is less"), "");
}

TEST(Ids, CheckTheirRange) {
  EXPECT_EQ(AgentId(UINT32_MAX).index(), UINT32_MAX);
  const ScopedHandler scoped(throw_broken);
  EXPECT_THROW((void)AgentId(std::size_t{UINT32_MAX} + 1), Broken);
  EXPECT_THROW((void)VertexId(SIZE_MAX), Broken);
  static_assert(VertexId(7).index() == 7);
}

}  // namespace
}  // namespace quadrille
