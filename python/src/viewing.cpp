// SPDX-License-Identifier: MIT
// Plans as pages and pictures.
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/view/page.hpp"
#include "quadrille/view/picture.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

view::PageOptions page_options(std::string title, std::vector<std::string> names) {
  view::PageOptions options;
  options.title = std::move(title);
  options.agent_names = std::move(names);
  return options;
}

view::PictureOptions picture_options(const std::string& kind, std::string title,
                                     const std::vector<std::size_t>& agents) {
  view::PictureOptions options;
  const auto known = view::parse_picture_kind(kind);
  if (!known) refuse("kind: '" + kind + "' is not map, space-time or waits");
  options.kind = *known;
  options.title = std::move(title);
  for (const std::size_t agent : agents) options.agents.emplace_back(agent);
  return options;
}

std::string step_page(const discrete::Instance& instance, const discrete::Plan& plan,
                      std::string title, std::vector<std::string> names) {
  const py::gil_scoped_release release;
  return view::page(instance, plan, page_options(std::move(title), std::move(names)));
}

std::string timed_page(const TimedInstance& instance, const continuous::Plan& plan,
                       std::string title, std::vector<std::string> names) {
  const continuous::Instance& made = instance.instance();
  const py::gil_scoped_release release;
  return view::page(made, plan, page_options(std::move(title), std::move(names)),
                    instance.grid_or_null());
}

std::string step_picture(const discrete::Instance& instance, const discrete::Plan& plan,
                         const std::string& kind, std::string title,
                         const std::vector<std::size_t>& agents) {
  return take(view::picture(instance, plan, picture_options(kind, std::move(title), agents)));
}

std::string timed_picture(const TimedInstance& instance, const continuous::Plan& plan,
                          const std::string& kind, std::string title,
                          const std::vector<std::size_t>& agents) {
  return take(view::picture(instance.instance(), plan,
                            picture_options(kind, std::move(title), agents),
                            instance.grid_or_null()));
}

}  // namespace

void bind_viewing(py::module_& module) {
  module.def("step_page", &step_page);
  module.def("timed_page", &timed_page);
  module.def("step_picture", &step_picture);
  module.def("timed_picture", &timed_picture);
}

}  // namespace quadrille::python
