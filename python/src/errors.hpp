// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <utility>

#include "quadrille/core/result.hpp"

namespace quadrille::python {

namespace py = pybind11;

/// Raises quadrille.InputError, with the text that the program shows. Needs the GIL.
[[noreturn]] void raise(const Error& error);
/// As above, about an argument instead of a file.
[[noreturn]] void refuse(const std::string& message);

/// The value; raises the error.
template <class T>
T take(Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}
inline void check(const std::optional<Error>& error) {
  if (error) raise(*error);
}

}  // namespace quadrille::python
