// SPDX-License-Identifier: MIT
#include "quadrille/core/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace quadrille {
namespace {

using testing::HasSubstr;

TEST(Settings, EachHasALineWithItsOwnNameAndADefaultInItsRange) {
  std::set<std::string_view> names;
  std::set<const std::int64_t*> values;
  const Settings settings;
  for (const SettingInfo& info : settings_table()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(values.insert(&(settings.*info.value)).second) << info.name;
    EXPECT_FALSE(info.unit.empty()) << info.name;
    EXPECT_FALSE(info.meaning.empty()) << info.name;
  }
  EXPECT_EQ(values.size() * sizeof(std::int64_t), sizeof(Settings));
  EXPECT_EQ(check_settings(settings), std::nullopt);
}

TEST(Settings, AreAssignedByName) {
  Settings settings;
  EXPECT_EQ(assign_setting(settings, "core_passes=7"), std::nullopt);
  EXPECT_EQ(settings.core_passes, 7);
  EXPECT_EQ(settings.core_turn, Settings().core_turn);
}

TEST(Settings, RefuseWhatIsNoAssignment) {
  Settings settings;
  for (const char* text : {"core_passes", "core_passes=", "core_passes=x", "core_passes=7x",
                           "core_passes= 7", "core_passes=99999999999999999999"}) {
    const auto error = assign_setting(settings, text);
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code, ErrorCode::syntax) << text;
    EXPECT_THAT(error->message, HasSubstr("core_passes"));
  }
  for (const char* text : {"", "=", "core=7", "core_passes=0", "core_passes=-1"}) {
    const auto error = assign_setting(settings, text);
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->code, ErrorCode::out_of_range) << text;
  }
  EXPECT_EQ(settings.core_passes, Settings().core_passes);
}

TEST(Settings, AreHeldToTheirRanges) {
  for (const SettingInfo& info : settings_table()) {
    Settings settings;
    for (const std::int64_t value : {info.least, info.most}) {
      settings.*info.value = value;
      EXPECT_EQ(check_settings(settings), std::nullopt) << info.name;
    }
    for (const std::int64_t value : {info.least - 1, info.most + 1}) {
      settings.*info.value = value;
      const auto error = check_settings(settings);
      ASSERT_TRUE(error) << info.name;
      EXPECT_THAT(error->message, HasSubstr(std::string(info.name)));
    }
  }
}

}  // namespace
}  // namespace quadrille
