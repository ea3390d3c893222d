// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/stl.h>

#include <cstddef>
#include <vector>

#include "bindings.hpp"
#include "quadrille/dispatch/task.hpp"

namespace quadrille::python {

/// Calls a dispatcher, and tells what came of it. `tick()`: dispatch::News; without the GIL.
/// `in_units`: of a cost, a number in the fleet's unit of time.
template <class Tick, class InUnits>
py::dict told_of(const Tick& tick, const InUnits& in_units) {
  dispatch::News news;
  {
    const py::gil_scoped_release release;
    news = tick();
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  std::vector<std::size_t> served;
  for (const AgentId robot : news.served) served.push_back(robot.index());
  py::dict told;
  told["served"] = served;
  told["waiting"] = news.num_waiting;
  told["has_new_plan"] = news.has_new_plan;
  told["cost"] = in_units(news.cost);
  told["lower_bound"] = in_units(news.lower_bound);
  return told;
}

}  // namespace quadrille::python
