// SPDX-License-Identifier: MIT
#include "quadrille/core/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace quadrille {
namespace {

Error error_of(const char* message) { return {ErrorCode::syntax, message, {"f", 3}}; }

Result<int> half(int number) {
  if (number % 2 != 0) return error_of("odd");
  return number / 2;
}

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> six = half(12), none = half(7);
  EXPECT_TRUE(six.has_value());
  EXPECT_EQ(*six, 6);
  EXPECT_FALSE(none);
  EXPECT_EQ(none.error().to_string(), "f:3: odd");
  EXPECT_DEATH((void)none.value(), "the value of a Result that is an error");
  EXPECT_DEATH((void)*none, "the value of a Result that is an error");
  EXPECT_DEATH((void)six.error(), "the error of a Result that is a value");
}

TEST(Result, ErrorsLeaveOutWhatIsUnknown) {
  EXPECT_EQ((Error{ErrorCode::io, "gone", {"f", 0}}.to_string()), "f: gone");
  EXPECT_EQ((Error{ErrorCode::io, "gone", {}}.to_string()), "gone");
}

TEST(Result, WhatCannotBeCopiedIsMovedOut) {
  const auto make = [] { return Result<std::unique_ptr<int>>(std::make_unique<int>(5)); };
  EXPECT_EQ(*make().value(), 5);
  const std::unique_ptr<int> taken = *make();
  EXPECT_EQ(*taken, 5);
  EXPECT_EQ(*make().value_or(nullptr), 5);
  const Result<int> sum = make().and_then([](std::unique_ptr<int>&& p) { return half(*p * 2); });
  EXPECT_EQ(*sum, 5);
  Result<std::unique_ptr<int>> failed = error_of("no");
  EXPECT_EQ(std::move(failed).value_or(nullptr), nullptr);
  const Error error = std::move(failed).error();
  EXPECT_EQ(error.message, "no");
}

TEST(Result, CanBeChanged) {
  Result<std::string> text = std::string("a");
  *text += "b";
  text->push_back('c');
  EXPECT_EQ(text.value(), "abc");
}

TEST(Result, ValueOrTakesWhatConverts) {
  const Result<std::string> text = std::string("a"), none = error_of("no");
  EXPECT_EQ(text.value_or("b"), "a");
  EXPECT_EQ(none.value_or("b"), "b");
}

TEST(Result, AndThenStopsAtTheFirstError) {
  EXPECT_EQ(*half(12).and_then(half), 3);
  EXPECT_EQ(half(14).and_then(half).error().message, "odd");
  int calls = 0;
  const Result<int> none = half(7);
  const auto count = [&](int) -> Result<std::string> {
    ++calls;
    return std::string();
  };
  EXPECT_EQ(none.and_then(count).error().message, "odd");
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(half(2).and_then(count).has_value());
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace quadrille
