// SPDX-License-Identifier: MIT
#include "quadrille/sat/dependence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quadrille::sat {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<AgentId> bystanders(const Dependence& dependence, std::vector<AgentId> agents) {
  Raise raise{RaiseKind::core, 1, std::move(agents), {AgentId(7)}};
  dependence.add_bystanders(raise);
  return raise.bystanders;
}

constexpr AgentId kA(0), kB(1), kC(2), kD(3), kE(4);

TEST(Dependence, ALinkAloneIsNone) {
  Dependence dependence(5);
  dependence.link(kA, kB);
  EXPECT_THAT(bystanders(dependence, {kA}), IsEmpty());
}

TEST(Dependence, UnconditionalAgentsCountWhereTheyAreLinked) {
  Dependence dependence(5);
  dependence.link(kB, kA);
  dependence.link(kB, kC);
  dependence.link(kC, kD);
  dependence.set_unconditional(kB);
  dependence.set_unconditional(kD);
  EXPECT_THAT(bystanders(dependence, {kA}), ElementsAre(kB));
  EXPECT_THAT(bystanders(dependence, {kB}), IsEmpty());
  dependence.set_unconditional(kC);
  EXPECT_THAT(bystanders(dependence, {kA}), ElementsAre(kB, kC, kD));
  EXPECT_THAT(bystanders(dependence, {kA, kC}), ElementsAre(kB, kD));
  EXPECT_THAT(bystanders(dependence, {kE}), IsEmpty());
}

TEST(Dependence, CoresBringTheirCeilings) {
  Dependence dependence(5);
  dependence.imply({kA, kB}, {kC});
  dependence.imply({kC}, {kD});
  EXPECT_THAT(bystanders(dependence, {kA}), IsEmpty());
  EXPECT_THAT(bystanders(dependence, {kA, kB}), ElementsAre(kC, kD));
  EXPECT_THAT(bystanders(dependence, {kB, kC}), ElementsAre(kD));
  EXPECT_THAT(bystanders(dependence, {kA, kB, kC, kD}), IsEmpty());
}

TEST(Dependence, SomeCountEverywhere) {
  Dependence dependence(5);
  dependence.imply({}, {kE});
  dependence.link(kE, kD);
  dependence.set_unconditional(kD);
  EXPECT_THAT(bystanders(dependence, {kA}), ElementsAre(kD, kE));
}

}  // namespace
}  // namespace quadrille::sat
