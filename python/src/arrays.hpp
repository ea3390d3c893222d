// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace quadrille::python {

namespace py = pybind11;

// What the Python files hand over: the shape, the type and the order in memory are settled there.
using Bools = py::array_t<bool, py::array::c_style>;
using Ints = py::array_t<std::int64_t, py::array::c_style>;
using Bits = py::array_t<std::uint64_t, py::array::c_style>;
using Doubles = py::array_t<double, py::array::c_style>;

/// A new array, whose entries are not set yet.
template <class T>
py::array_t<T> new_array(std::initializer_list<std::size_t> shape) {
  std::vector<py::ssize_t> sizes;
  for (const std::size_t size : shape) sizes.push_back(static_cast<py::ssize_t>(size));
  return py::array_t<T>(sizes);
}

/// The entries, row by row.
inline std::vector<bool> flags_of(const Bools& array) {
  return std::vector<bool>(array.data(), array.data() + array.size());
}

/// From now on the array cannot be written to.
inline py::array frozen(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The memory of `owner`, seen as a read-only array: nothing is copied, and `owner` lives as long
/// as the array does.
inline py::array view_of(const void* data, const py::dtype& type, std::vector<py::ssize_t> shape,
                         std::vector<py::ssize_t> strides, const py::object& owner) {
  return frozen(py::array(type, std::move(shape), std::move(strides), data, owner));
}

}  // namespace quadrille::python
