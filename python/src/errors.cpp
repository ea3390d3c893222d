// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include "quadrille/core/terminal_text.hpp"

namespace quadrille::python {
namespace {

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::io:
      return "io";
    case ErrorCode::syntax:
      return "syntax";
    case ErrorCode::invalid_instance:
      return "invalid-instance";
    case ErrorCode::no_plan:
      return "no-plan";
    case ErrorCode::out_of_range:
      return "out-of-range";
    case ErrorCode::invalid_plan:
      return "invalid-plan";
    case ErrorCode::internal:
      break;
  }
  return "internal";
}

}  // namespace

void raise(const Error& error) {
  const py::object make = py::module_::import("quadrille._errors").attr("make_error");
  const py::object exception =
      make(name_of(error.code), error.to_string(), terminal_line(error.message), error.where.file,
           error.where.line);
  PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
  throw py::error_already_set();
}

void refuse(const std::string& message) { raise({ErrorCode::out_of_range, message, {}}); }

}  // namespace quadrille::python
