// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

namespace quadrille::python {

// What the Python files of the package are made of: names, arrays and numbers of the library's own
// units. Docstrings are with the classes that users see.
void bind_steps(pybind11::module_& module);             ///< The discrete domain.
void bind_timed(pybind11::module_& module);             ///< The continuous domain.
void bind_timed_graph(pybind11::module_& module);       ///< A part of it: roadmaps.
void bind_poses(pybind11::module_& module);             ///< Robots that turn on roadmaps.
void bind_precedences(pybind11::module_& module);       ///< Of plans of either.
void bind_dispatching(pybind11::module_& module);       ///< Live fleets.
void bind_grid_dispatching(pybind11::module_& module);  ///< The same on grids and graphs.
void bind_executing(pybind11::module_& module);         ///< Who may go on, with plans of either.
void bind_exporting(pybind11::module_& module);         ///< Plans for other systems.
void bind_session(pybind11::module_& module);  ///< Solving again and again, in continuous time.
void bind_step_session(pybind11::module_& module);  ///< The same in timesteps.
void bind_viewing(pybind11::module_& module);       ///< Pages and pictures of either.
void bind_reading(pybind11::module_& module);       ///< Files of either.

}  // namespace quadrille::python
