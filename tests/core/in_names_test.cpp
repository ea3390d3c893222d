// SPDX-License-Identifier: MIT
#include "quadrille/core/in_names.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace quadrille {
namespace {

std::string said(const std::string& message) {
  const std::vector<std::string> agents{"'amr'", "", "'cart'"}, vertices{"'dock'", "'bay'"};
  const auto of = [](const std::vector<std::string>& names) {
    return [&names](std::size_t i) {
      return i < names.size() && !names[i].empty() ? std::optional(names[i]) : std::nullopt;
    };
  };
  return in_names(message, {of(agents), of(vertices)});
}

TEST(InNames, NamesStandForNumbers) {
  EXPECT_EQ(said("agents 0 and 2 collide, while agent 0 waits at vertex 1"),
            "'amr' and 'cart' collide, while 'amr' waits at 'bay'");
  EXPECT_EQ(said("agents 0, 2 and 0"), "'amr', 'cart' and 'amr'");
  EXPECT_EQ(said("vertices 0 and 1"), "'dock' and 'bay'");
  EXPECT_EQ(said("agent 2"), "'cart'");
  EXPECT_EQ(said("the clock of robot 0 goes back"), "the clock of 'amr' goes back");
}

TEST(InNames, WhatHasNoNameKeepsItsNumber) {
  EXPECT_EQ(said("agent 1 at vertex 2"), "agent 1 at vertex 2");
  EXPECT_EQ(said("agents 0 and 1 collide"), "agents 0 and 1 collide");
  EXPECT_EQ(said("agent 7, agent 0"), "agent 7, 'amr'");
}

TEST(InNames, NothingElseIsTouched) {
  for (const char* text : {"", "agent", "agent ", "agents of 0", "reagent 0", "agent 0.5",
                           "agent 0th", "agent 99999999999999999999", "plan.json:3: 2 agents"})
    EXPECT_EQ(said(text), text);
  EXPECT_EQ(said("agent 0."), "'amr'.");
  EXPECT_EQ(said("agent 0, at 3"), "'amr', at 3");
}

}  // namespace
}  // namespace quadrille
