// SPDX-License-Identifier: MIT
#include "quadrille/core/terminal_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "quadrille/core/result.hpp"

namespace quadrille {
namespace {

TEST(TerminalText, LeavesOrdinaryTextAlone) {
  for (const char* text :
       {"", "plain", "two\nlines\tand a tab\n", "grün, 日本語, 🤖, \u200d", "a\\u001b"})
    EXPECT_EQ(terminal_text(text), text);
}

TEST(TerminalText, EscapesControlCharacters) {
  EXPECT_EQ(terminal_text("\x1b[31m\a\r\x7f"), "\\u001b[31m\\u0007\\u000d\\u007f");
  EXPECT_EQ(terminal_text(std::string("\0x", 2)), "\\u0000x");
  EXPECT_EQ(terminal_text("\u0080\u0085\u009b\u009f\u00a0"), "\\u0080\\u0085\\u009b\\u009f\u00a0");
  EXPECT_EQ(terminal_text("\u2028\u2029"), "\\u2028\\u2029");
}

TEST(TerminalText, EscapesChangesOfDirection) {
  EXPECT_EQ(terminal_text("\u061c\u200e\u200f"), "\\u061c\\u200e\\u200f");
  EXPECT_EQ(terminal_text("\u202a\u202b\u202c\u202d\u202e"), "\\u202a\\u202b\\u202c\\u202d\\u202e");
  EXPECT_EQ(terminal_text("\u2066\u2067\u2068\u2069"), "\\u2066\\u2067\\u2068\\u2069");
}

TEST(TerminalText, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(terminal_text("\x9b\xff"), "\\x9b\\xff");
  EXPECT_EQ(terminal_text("\xc2"), "\\xc2");  // Cut off.
  EXPECT_EQ(terminal_text("\xc2x"), "\\xc2x");
  EXPECT_EQ(terminal_text("\xc0\x9b"), "\\xc0\\x9b");  // Not the shortest form.
  EXPECT_EQ(terminal_text("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
  EXPECT_EQ(terminal_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // Half of a surrogate pair.
  EXPECT_EQ(terminal_text("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(TerminalText, MakesOneLine) {
  EXPECT_EQ(terminal_line("a\nb\n"), "a\\nb\\n");
  EXPECT_EQ(terminal_line("a\tb"), "a\tb");
}

TEST(TerminalText, ChangesNothingTheSecondTime) {
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  const std::string once = terminal_line(all);
  EXPECT_EQ(terminal_line(once), once);
}

TEST(TerminalText, IsWhatErrorsSay) {
  EXPECT_EQ((Error{ErrorCode::io, "no\x1b\n", {"f\a", 3}}.to_string()), "f\\u0007:3: no\\u001b\\n");
}

}  // namespace
}  // namespace quadrille
