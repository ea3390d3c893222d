// SPDX-License-Identifier: MIT
// Agents that carry out a plan: who may go on. Times are whole ticks or timesteps.
#include "executing.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "errors.hpp"
#include "quadrille/execution/clearance.hpp"
#include "quadrille/execution/executor.hpp"
#include "quadrille/execution/releaser.hpp"
#include "quadrille/execution/simulation.hpp"

namespace quadrille::python {
namespace {

using execution::Executor;
using execution::Precedences;
using execution::Releaser;
using execution::Ticks;

std::vector<Ticks> ticks_of(const Ints& array) {
  std::vector<Ticks> ticks;
  for (py::ssize_t i = 0; i < array.size(); ++i) ticks.emplace_back(array.at(i));
  return ticks;
}

py::array array_of(std::span<const Ticks> ticks) {
  auto array = new_array<std::int64_t>({ticks.size()});
  std::transform(ticks.begin(), ticks.end(), array.mutable_data(),
                 [](Ticks time) { return time.value(); });
  return frozen(array);
}

/// The rules, with what their callers have to keep looked at.
class Executing {
 public:
  explicit Executing(const Precedences& order) : executor_(order) { reset(order); }

  void reset(const Precedences& order) {
    executor_.reset();
    clocks_.assign(order.num_agents(), order.now);
  }

  py::array limits(const Ints& clocks) {
    move_on(clocks);
    std::vector<Ticks> limits(clocks_.size());
    executor_.limits(clocks_, limits);
    return array_of(limits);
  }
  py::array couple(const Ints& clocks, const Ints& targets) {
    return step(clocks, targets, &Executor::couple);
  }
  py::array gate(const Ints& clocks, const Ints& targets) {
    return step(clocks, targets, &Executor::gate);
  }

 private:
  void move_on(const Ints& given) {
    const std::vector<Ticks> clocks = ticks_of(given);
    for (std::size_t i = 0; i < clocks.size(); ++i)
      if (clocks[i] < clocks_[i])
        refuse("clocks[" + std::to_string(i) + "]: a clock never goes back");
    clocks_ = clocks;
  }
  py::array step(const Ints& clocks, const Ints& given,
                 void (Executor::*rule)(std::span<const Ticks>, std::span<Ticks>)) {
    std::vector<Ticks> targets = ticks_of(given);
    for (std::size_t i = 0; i < targets.size(); ++i)
      if (targets[i] < Ticks(clocks.at(static_cast<py::ssize_t>(i))))
        refuse("targets[" + std::to_string(i) + "]: it is before the clock");
    move_on(clocks);
    (executor_.*rule)(clocks_, targets);
    return array_of(targets);
  }

  Executor executor_;
  std::vector<Ticks> clocks_;
};

/// Whole moves.
class Releasing {
 public:
  explicit Releasing(const Precedences& order) : releaser_(order), ended_(order.num_agents(), 0) {}

  [[nodiscard]] std::uint32_t released(std::size_t agent) const {
    return releaser_.released(AgentId(agent));
  }
  void end_moves(std::size_t agent, std::int64_t count) {
    const std::int64_t most = released(agent), least = ended_[agent];
    if (count < least) refuse("count: " + std::to_string(least) + " moves have ended already");
    if (count > most)
      refuse("count: " + std::to_string(count) + " moves have ended, and " + std::to_string(most) +
             " were released");
    ended_[agent] = count;
    releaser_.end_moves(AgentId(agent), static_cast<std::uint32_t>(count));
  }
  [[nodiscard]] std::vector<std::size_t> take_news() {
    std::vector<std::size_t> agents;
    for (const AgentId agent : releaser_.take_news()) agents.push_back(agent.index());
    return agents;
  }

 private:
  Releaser releaser_;
  std::vector<std::int64_t> ended_;
};

/// What becomes of one run: (all arrived, finish int64[n], held int64[n], contacts, least gap in
/// length units or NaN).
template <class Watch>
py::tuple run(const Precedences& order, const execution::DelayOptions& options, std::uint64_t seed,
              execution::Rule rule, Ticks period, Watch& watch) {
  execution::SimulationResult result;
  {
    const py::gil_scoped_release release;
    result = simulate(order, draw_delays(order, options, seed), rule, period,
                      [&](std::span<const Ticks> before, std::span<const Ticks> after) {
                        watch.add(before, after);
                      });
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  double gap = std::numeric_limits<double>::quiet_NaN();
  if constexpr (requires { watch.least(); })
    if (std::isfinite(watch.least())) gap = watch.least();
  return py::make_tuple(result.all_arrived, array_of({result.finish.begin(), result.finish.end()}),
                        array_of({result.held.begin(), result.held.end()}), watch.contacts().size(),
                        gap);
}

execution::DelayOptions options_of(double chance, std::int64_t longest, double slowness) {
  execution::DelayOptions options;
  options.pause_chance = chance;
  options.longest_pause = Ticks(longest);
  options.slowness = slowness;
  return options;
}

execution::Rule rule_of(const std::string& name) {
  const auto rule = execution::parse_rule(name);
  if (!rule) refuse("rule: '" + name + "' is not naive, gated or coupled");
  return *rule;
}

}  // namespace

void bind_executing(py::module_& module) {
  py::class_<Executing>(module, "Executor")
      .def(py::init<const Precedences&>())
      .def("reset", &Executing::reset)
      .def("limits", &Executing::limits)
      .def("couple", &Executing::couple)
      .def("gate", &Executing::gate);
  module.attr("UNLIMITED") = Executor::kUnlimited.value();
  py::class_<Releasing>(module, "Releaser")
      .def(py::init<const Precedences&>())
      .def("released", &Releasing::released)
      .def("end_moves", &Releasing::end_moves)
      .def("take_news", &Releasing::take_news);
  module.def("step_run", [](const Precedences& order, const discrete::Instance& instance,
                            const discrete::Plan& plan, double chance, std::int64_t longest,
                            double slowness, std::uint64_t seed, const std::string& rule) {
    IdVector<AgentId, bool> leaves;
    for (const discrete::Agent& agent : instance.agents()) leaves.push_back(agent.leaves);
    execution::ConflictWatch watch(plan, std::move(leaves));
    return run(order, options_of(chance, longest, slowness), seed, rule_of(rule), 1, watch);
  });
  module.def("timed_run",
             [](const Precedences& order, const TimedInstance& self, const continuous::Plan& plan,
                double chance, std::int64_t longest, double slowness, std::uint64_t seed,
                const std::string& rule, std::int64_t period) {
               execution::ClearanceWatch watch(self.instance(), plan);
               return run(order, options_of(chance, longest, slowness), seed, rule_of(rule),
                          Ticks(period), watch);
             });
}

}  // namespace quadrille::python
