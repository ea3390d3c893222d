// SPDX-License-Identifier: MIT
#include "quadrille/lazy/path_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace quadrille::lazy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// Paths are words.
class Cache {
 public:
  explicit Cache(std::size_t capacity) : cache_(2, capacity) {}
  /// Whether it was known.
  bool add(const std::string& path, std::size_t agent = 0) {
    bool is_known = true;
    const std::string& kept = cache_.remember(
        AgentId(agent), [&](const std::string& known) { return known == path; },
        [&] {
          is_known = false;
          return path;
        });
    EXPECT_EQ(kept, path);
    return is_known;
  }
  [[nodiscard]] const std::vector<std::string>& paths(std::size_t agent = 0) const {
    return cache_.paths(AgentId(agent));
  }

 private:
  PathCache<std::string> cache_;
};

TEST(PathCache, KeepsTheLastDifferentPathsOfEachAgentApart) {
  Cache cache(3);
  EXPECT_THAT(cache.paths(), IsEmpty());
  EXPECT_FALSE(cache.add("ab"));
  EXPECT_FALSE(cache.add("aab"));
  EXPECT_TRUE(cache.add("ab"));
  EXPECT_FALSE(cache.add("cd", 1));
  EXPECT_THAT(cache.paths(), UnorderedElementsAre("ab", "aab"));
  EXPECT_THAT(cache.paths(1), UnorderedElementsAre("cd"));
}

TEST(PathCache, ForgetsWhatWasFoundLongestAgo) {
  Cache cache(3);
  for (const char* path : {"a", "b", "c"}) cache.add(path);
  EXPECT_THAT(cache.paths(), ElementsAre("c", "b", "a"));
  EXPECT_TRUE(cache.add("a"));
  EXPECT_THAT(cache.paths(), ElementsAre("a", "c", "b"));
  EXPECT_FALSE(cache.add("d"));
  EXPECT_THAT(cache.paths(), ElementsAre("d", "a", "c"));
  EXPECT_FALSE(cache.add("b"));
  EXPECT_THAT(cache.paths(), ElementsAre("b", "d", "a"));
}

}  // namespace
}  // namespace quadrille::lazy
