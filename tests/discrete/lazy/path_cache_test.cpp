// SPDX-License-Identifier: MIT
#include "lazy/path_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace quadrille::discrete {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

Path path_of(const std::string& letters) {
  Path path;
  for (const char c : letters) path.push_back(VertexId(static_cast<std::size_t>(c - 'a')));
  return path;
}

TEST(PathCache, KeepsTheLastDifferentPathsOfEachAgentApart) {
  PathCache cache(2, 3);
  EXPECT_THAT(cache.paths(AgentId(0)), IsEmpty());
  cache.add(AgentId(0), path_of("ab"));
  cache.add(AgentId(0), path_of("aab"));
  cache.add(AgentId(0), path_of("ab"));
  cache.add(AgentId(1), path_of("cd"));
  EXPECT_THAT(cache.paths(AgentId(0)), UnorderedElementsAre(path_of("ab"), path_of("aab")));
  EXPECT_THAT(cache.paths(AgentId(1)), UnorderedElementsAre(path_of("cd")));
}

TEST(PathCache, ForgetsTheOldestPathFirst) {
  PathCache cache(1, 3);
  for (const char* path : {"ab", "aab", "aaab", "aaaab", "aab", "aaaaab"})
    cache.add(AgentId(0), path_of(path));
  EXPECT_THAT(cache.paths(AgentId(0)),
              UnorderedElementsAre(path_of("aaab"), path_of("aaaab"), path_of("aaaaab")));
}

TEST(PathCache, WithoutRoomRemembersNothing) {
  PathCache cache(1, 0);
  cache.add(AgentId(0), path_of("ab"));
  EXPECT_THAT(cache.paths(AgentId(0)), IsEmpty());
}

}  // namespace
}  // namespace quadrille::discrete
