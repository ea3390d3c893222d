// SPDX-License-Identifier: MIT
#include "bindings.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "What the package quadrille is built on; not for users.";
  module.attr("__version__") = QUADRILLE_VERSION;
  quadrille::python::bind_steps(module);
  quadrille::python::bind_timed(module);
  quadrille::python::bind_poses(module);
  quadrille::python::bind_precedences(module);
  quadrille::python::bind_executing(module);
  quadrille::python::bind_exporting(module);
  quadrille::python::bind_session(module);
  quadrille::python::bind_step_session(module);
  quadrille::python::bind_dispatching(module);
  quadrille::python::bind_grid_dispatching(module);
  quadrille::python::bind_viewing(module);
  quadrille::python::bind_reading(module);
}
