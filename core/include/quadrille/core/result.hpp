// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "quadrille/core/contract.hpp"

namespace quadrille {

enum class ErrorCode {
  io,                ///< A file cannot be opened, read or written.
  syntax,            ///< A file does not follow its format.
  invalid_instance,  ///< The parts are well-formed but contradict each other.
  no_plan,           ///< An instance is well-formed, but it can be seen that no plan exists.
  out_of_range,      ///< A number is outside what the program supports.
  invalid_plan,      ///< A plan does not fit its instance.
  internal,          ///< A check of the program's own work failed.
};

/// Where an error was found. An empty file means "not from a file"; line 0 means "no line".
struct SourcePlace {
  std::string file;
  long line = 0;
};

/// One reason why an operation was refused.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string message;
  SourcePlace where;

  /// `file:line: message`, leaving out what is unknown.
  [[nodiscard]] std::string to_string() const {
    std::string text;
    if (!where.file.empty()) {
      text += where.file;
      if (where.line > 0) text += ":" + std::to_string(where.line);
      text += ": ";
    }
    return text + message;
  }
};

/// Either a value or the Error that prevented it (the names of std::expected).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}  // NOLINT: implicit, so that `return value;` works
  Result(Error error)
      : state_(std::move(error)) {}  // NOLINT: implicit, so that `return error;` works

  [[nodiscard]] bool has_value() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }

  /// Requires has_value().
  [[nodiscard]] const T& value() const& {
    QUADRILLE_REQUIRE(has_value(), "Result::value() of an error");
    return std::get<0>(state_);
  }
  [[nodiscard]] T& value() & {
    QUADRILLE_REQUIRE(has_value(), "Result::value() of an error");
    return std::get<0>(state_);
  }
  [[nodiscard]] T&& value() && {
    QUADRILLE_REQUIRE(has_value(), "Result::value() of an error");
    return std::get<0>(std::move(state_));
  }
  [[nodiscard]] const T& operator*() const& { return value(); }
  [[nodiscard]] const T* operator->() const { return &value(); }

  /// Requires !has_value().
  [[nodiscard]] const Error& error() const {
    QUADRILLE_REQUIRE(!has_value(), "Result::error() of a value");
    return std::get<1>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace quadrille
