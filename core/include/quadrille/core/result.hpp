// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/export.hpp"

QUADRILLE_API_BEGIN

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
  [[nodiscard]] std::string to_string() const;
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
  [[nodiscard]] const T& value() const& { return *checked(this); }
  [[nodiscard]] T& value() & { return *checked(this); }
  [[nodiscard]] T&& value() && { return std::move(*checked(this)); }
  [[nodiscard]] const T& operator*() const& { return *checked(this); }
  [[nodiscard]] T& operator*() & { return *checked(this); }
  [[nodiscard]] T&& operator*() && { return std::move(*checked(this)); }
  [[nodiscard]] const T* operator->() const { return checked(this); }
  [[nodiscard]] T* operator->() { return checked(this); }

  /// Requires !has_value().
  [[nodiscard]] const Error& error() const& { return *checked_error(this); }
  [[nodiscard]] Error&& error() && { return std::move(*checked_error(this)); }

  /// The value, or `otherwise`, which has to convert to T.
  template <class U>
  [[nodiscard]] T value_or(U&& otherwise) const& {
    return has_value() ? **this : static_cast<T>(std::forward<U>(otherwise));
  }
  template <class U>
  [[nodiscard]] T value_or(U&& otherwise) && {
    return has_value() ? *std::move(*this) : static_cast<T>(std::forward<U>(otherwise));
  }

  /// What `next`, a function from T to a Result, makes of the value; or the error.
  template <class F>
  [[nodiscard]] auto and_then(F&& next) const& -> std::invoke_result_t<F, const T&> {
    if (!has_value()) return error();
    return std::invoke(std::forward<F>(next), **this);
  }
  template <class F>
  [[nodiscard]] auto and_then(F&& next) && -> std::invoke_result_t<F, T&&> {
    if (!has_value()) return std::move(*this).error();
    return std::invoke(std::forward<F>(next), *std::move(*this));
  }

 private:
  template <class Self>
  static auto checked(Self* self) {
    auto* const value = std::get_if<0>(&self->state_);
    QUADRILLE_REQUIRE(value != nullptr, "the value of a Result that is an error");
    return value;
  }
  template <class Self>
  static auto checked_error(Self* self) {
    auto* const error = std::get_if<1>(&self->state_);
    QUADRILLE_REQUIRE(error != nullptr, "the error of a Result that is a value");
    return error;
  }

  std::variant<T, Error> state_;
};

}  // namespace quadrille

QUADRILLE_API_END
