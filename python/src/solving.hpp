// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <string>
#include <utility>

#include "attribution.hpp"
#include "conversation.hpp"
#include "options.hpp"

namespace quadrille::python {

/// The parts of an outcome but for its attribution, by name, as quadrille.solving makes a Result of
/// them. Costs are those of the library: timesteps or ticks.
template <class Outcome>
py::dict outcome_of(Outcome outcome) {
  py::dict dict;
  dict["status"] = std::string(to_string(outcome.status));
  dict["cost"] = outcome.cost;
  dict["lower_bound"] =
      outcome.status == Status::infeasible ? std::nullopt : std::optional(outcome.lower_bound);
  dict["rests_on_known_bound"] = outcome.rests_on_known_bound;
  dict["stop"] = std::string(to_string(outcome.stop));
  dict["explanation"] = outcome.explanation;
  dict["internal_error"] = outcome.internal_error
                               ? py::object(py::str(outcome.internal_error->to_string()))
                               : py::object(py::none());
  dict["statistics"] = statistics_of(outcome.statistics);
  dict["attribution"] = py::none();
  dict["moves"] = py::none();
  if constexpr (requires { outcome.moves; })
    if (outcome.moves)
      dict["moves"] = py::make_tuple(outcome.moves->number, outcome.moves->lower_bound,
                                     outcome.moves->is_proved);
  dict["plan"] = outcome.plan ? py::cast(*std::move(outcome.plan)) : py::object(py::none());
  return dict;
}

/// Solves with `options` but for the callbacks, which the arguments may name: `progress` is called
/// with (phase, lower bound, cost or None, seconds, conflicts), `on_plan` with the plan.
/// `interrupt` is where the options' flag has to point. `search`: from the instance and the options
/// to an outcome.
template <class Plan, class Instance, class SetOptions, class Search>
py::dict run_solve(const Instance& instance, const py::dict& given, const SetOptions& set_options,
                   const Search& search) {
  Arguments arguments(given);
  const auto progress = arguments.take<py::function>("progress");
  const auto on_plan = arguments.take<py::function>("on_plan");
  std::function<void(const Progress&)> tell_progress;
  std::function<void(const Plan&)> tell_plan;
  if (progress)
    tell_progress = [&](const Progress& at) {
      (*progress)(std::string(to_string(at.phase)), at.lower_bound, at.cost, at.elapsed_s,
                  at.conflicts);
    };
  if (on_plan) tell_plan = [&](const Plan& plan) { (*on_plan)(py::cast(plan)); };
  Conversation<Plan> conversation(tell_progress, tell_plan);

  auto options = set_options(arguments, conversation.interrupt());
  if (progress) options.on_progress = [&](const Progress& at) { conversation.tell(at); };
  if (on_plan) options.on_plan = [&](const Plan& plan) { conversation.tell(plan); };
  auto outcome = take(conversation.run([&] { return search(instance, options); }));
  const py::object attribution = attribution_object(instance, outcome.attribution);
  py::dict parts = outcome_of(std::move(outcome));
  parts["attribution"] = attribution;
  parts["interrupted"] = conversation.was_interrupted();
  return parts;
}

template <class Plan, class Instance, class SetOptions>
py::dict run_solve(const Instance& instance, const py::dict& given, const SetOptions& set_options) {
  return run_solve<Plan>(
      instance, given, set_options,
      [](const Instance& what, const auto& options) { return solve(what, options); });
}

}  // namespace quadrille::python
