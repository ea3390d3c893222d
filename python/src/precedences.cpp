// SPDX-License-Identifier: MIT
// Which moves of a plan come before which.
#include "quadrille/execution/precedences.hpp"

#include <cstdint>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/execution/node_order.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

using execution::Precedences;

/// (moves int64[k, 6]: agent, move, from, to, begin, end; precedences int64[m, 5]: leading agent
/// and move, following agent and move, slack; cycle int64[k, 2]: agents and moves that wait for
/// each other when whole moves are released), in ticks or timesteps.
py::tuple arrays_of(const Precedences& precedences) {
  std::size_t count = 0;
  for (const auto& moves : precedences.moves) count += moves.size();
  auto moves = new_array<std::int64_t>({count, 6});
  std::int64_t* to = moves.mutable_data();
  for (const AgentId agent : IdRange<AgentId>(precedences.num_agents())) {
    std::int64_t number = 0;
    for (const execution::TimedMove& move : precedences.moves[agent]) {
      *to++ = static_cast<std::int64_t>(agent.index());
      *to++ = number++;
      *to++ = static_cast<std::int64_t>(move.from.index());
      *to++ = static_cast<std::int64_t>(move.to.index());
      *to++ = move.begin.value();
      *to++ = move.end.value();
    }
  }
  auto list = new_array<std::int64_t>({precedences.list.size(), 5});
  to = list.mutable_data();
  for (const execution::Precedence& precedence : precedences.list) {
    *to++ = static_cast<std::int64_t>(precedence.leader.agent.index());
    *to++ = precedence.leader.move;
    *to++ = static_cast<std::int64_t>(precedence.follower.agent.index());
    *to++ = precedence.follower.move;
    *to++ = precedence.slack.value();
  }
  const auto nodes = execution::node_order(precedences);
  auto cycle = new_array<std::int64_t>({nodes.cycle.size(), 2});
  to = cycle.mutable_data();
  for (const execution::MoveId& id : nodes.cycle) {
    *to++ = static_cast<std::int64_t>(id.agent.index());
    *to++ = id.move;
  }
  return py::make_tuple(frozen(moves), frozen(list), frozen(cycle));
}

template <class Instance, class Plan>
py::tuple precedences_of(const Instance& instance, const Plan& plan) {
  auto made = [&] {
    const py::gil_scoped_release release;
    return execution::precedences(instance, plan);
  }();
  if (!made) raise(made.error());
  return arrays_of(*made);
}

}  // namespace

void bind_precedences(py::module_& module) {
  module.def("step_precedences", &precedences_of<discrete::Instance, discrete::Plan>);
  module.def("timed_precedences", [](const TimedInstance& self, const continuous::Plan& plan) {
    return precedences_of(self.instance(), plan);
  });
}

}  // namespace quadrille::python
