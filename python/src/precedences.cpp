// SPDX-License-Identifier: MIT
// Which moves of a plan come before which, and what whole moves make of that.
#include "quadrille/execution/precedences.hpp"

#include <cstdint>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "executing.hpp"
#include "quadrille/execution/node_order.hpp"

namespace quadrille::python {
namespace {

using execution::MoveId;
using execution::Precedences;

std::int64_t* write(std::int64_t* to, const MoveId& id) {
  *to++ = static_cast<std::int64_t>(id.agent.index());
  *to++ = id.move;
  return to;
}

/// int64[k, 7]: agent, move, from, to, begin, end, in ticks or timesteps, and whether it goes on.
py::array moves_of(const Precedences& precedences) {
  std::size_t count = 0;
  for (const auto& moves : precedences.moves) count += moves.size();
  auto moves = new_array<std::int64_t>({count, 7});
  std::int64_t* to = moves.mutable_data();
  for (const AgentId agent : IdRange<AgentId>(precedences.num_agents())) {
    MoveId id{agent};
    for (const execution::TimedMove& move : precedences.moves[agent]) {
      to = write(to, id);
      ++id.move;
      *to++ = static_cast<std::int64_t>(move.from.index());
      *to++ = static_cast<std::int64_t>(move.to.index());
      *to++ = move.begin.value();
      *to++ = move.end.value();
      *to++ = move.goes_on ? 1 : 0;
    }
  }
  return frozen(moves);
}

/// int64[m, 5]: leading agent and move, following agent and move, slack.
py::array list_of(const Precedences& precedences) {
  auto list = new_array<std::int64_t>({precedences.list.size(), 5});
  std::int64_t* to = list.mutable_data();
  for (const execution::Precedence& precedence : precedences.list) {
    to = write(write(to, precedence.leader), precedence.follower);
    *to++ = precedence.slack.value();
  }
  return frozen(list);
}

/// (cycle int64[k, 2]: agents and moves, knots, moves in them, overlaps).
py::tuple node_order_of(const Precedences& precedences) {
  const auto nodes = execution::node_order(precedences);
  auto cycle = new_array<std::int64_t>({nodes.cycle.size(), 2});
  std::int64_t* to = cycle.mutable_data();
  for (const MoveId& id : nodes.cycle) to = write(to, id);
  return py::make_tuple(frozen(cycle), nodes.num_knots, nodes.num_knotted_moves,
                        nodes.num_overlaps);
}

template <class Instance, class Plan>
Precedences made_of(const Instance& instance, const Plan& plan) {
  return take([&] {
    const py::gil_scoped_release release;
    return execution::precedences(instance, plan);
  }());
}

}  // namespace

Precedences precedences_of(const discrete::Instance& instance, const discrete::Plan& plan) {
  return made_of(instance, plan);
}

Precedences precedences_of(const TimedInstance& self, const continuous::Plan& plan) {
  return made_of(self.instance(), plan);
}

void bind_precedences(py::module_& module) {
  py::class_<Precedences>(module, "Precedences")
      .def_property_readonly("num_agents", &Precedences::num_agents)
      .def("moves", &moves_of)
      .def("list", &list_of)
      .def("node_order", &node_order_of);
  module.def("step_precedences",
             py::overload_cast<const discrete::Instance&, const discrete::Plan&>(&precedences_of));
  module.def("timed_precedences",
             py::overload_cast<const TimedInstance&, const continuous::Plan&>(&precedences_of));
}

}  // namespace quadrille::python
