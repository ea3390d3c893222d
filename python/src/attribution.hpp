// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/core/attribution.hpp"
#include "quadrille/core/reasons.hpp"
#include "quadrille/discrete/instance.hpp"

namespace quadrille::python {

namespace py = pybind11;

/// A vertex, as Python knows it: (x, y) on grids in timesteps, else its number.
inline py::object vertex_object(const discrete::Instance& instance, VertexId v) {
  const auto& layout = instance.graph().layout();
  if (!layout) return py::int_(v.index());
  const auto cell = layout->cell_of(v);
  return py::make_tuple(cell.x, cell.y);
}
inline py::object vertex_object(const continuous::Instance&, VertexId v) {
  return py::int_(v.index());
}

inline py::tuple agents_tuple(const std::vector<AgentId>& agents) {
  py::list list;
  for (const AgentId i : agents) list.append(i.index());
  return py::tuple(list);
}

/// The parts of an attribution, as quadrille.attribution makes one of them: (free bound, lower
/// bound, [(free cost, cost)], [raise], [site], [reason]).
template <class Instance>
py::object attribution_object(const Instance& instance, const std::optional<Attribution>& given) {
  if (!given) return py::none();
  const auto place = [&](const Place& at) {
    return py::make_tuple(std::string(to_string(at.kind)), vertex_object(instance, at.from),
                          vertex_object(instance, at.to));
  };
  py::list agents, raises, sites, reasons;
  for (const AgentCharge& charge : given->agents)
    agents.append(py::make_tuple(charge.free_cost, charge.cost));
  for (const Raise& raise : given->raises)
    raises.append(py::make_tuple(std::string(to_string(raise.kind)), raise.amount,
                                 agents_tuple(raise.agents), agents_tuple(raise.bystanders)));
  for (const CollisionSite& site : given->sites)
    sites.append(py::make_tuple(
        py::make_tuple(site.first.index(), site.second.index()), place(site.place),
        site.other ? py::object(place(*site.other)) : py::object(py::none()), site.begin,
        site.end == CollisionSite::kForever ? std::nullopt : std::optional(site.end),
        site.num_lemmas));
  for (const Reason& reason : find_reasons(*given, {}))
    reasons.append(py::make_tuple(reason.amount, agents_tuple(reason.agents), reason.sites));
  return py::make_tuple(given->free_bound, given->lower_bound, agents, raises, sites, reasons);
}

}  // namespace quadrille::python
