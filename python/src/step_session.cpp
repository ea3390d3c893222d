// SPDX-License-Identifier: MIT
// Sessions on grids and graphs: agents that change, solved again and again.
#include <pybind11/stl.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/discrete/session.hpp"
#include "solving.hpp"
#include "steps.hpp"

namespace quadrille::python {
namespace {

using discrete::Graph;
using discrete::Instance;
using discrete::MemberId;
using discrete::Plan;

class StepSession {
 public:
  StepSession(std::shared_ptr<Graph> graph, Timestep now, Timestep robust)
      : graph_(std::move(graph)), session_(graph_, now, rules_of(robust)) {}

  /// An agent is an instance of one.
  std::size_t add(const Instance& agent) {
    return take(session_.add(agent.agents()[AgentId(0)])).index();
  }
  void change(std::size_t member, const Instance& agent) {
    check(session_.change(MemberId(member), agent.agents()[AgentId(0)]));
  }
  void remove(std::size_t member) { check(session_.remove(MemberId(member))); }
  void close(const Ints& place, const std::optional<Ints>& to) {
    check(session_.close(vertex(place), other(to)));
  }
  void open(const Ints& place, const std::optional<Ints>& to) {
    check(session_.open(vertex(place), other(to)));
  }
  void advance_to(Timestep now, const Plan& plan) { check(session_.advance_to(now, plan)); }
  [[nodiscard]] Timestep now() const { return session_.now(); }
  [[nodiscard]] std::vector<std::size_t> members() const {
    std::vector<std::size_t> members;
    for (const MemberId member : session_.members()) members.push_back(member.index());
    return members;
  }
  [[nodiscard]] Instance instance() const { return take(session_.instance()); }

  py::dict solve(const py::dict& arguments) {
    const auto search = [this](const Instance&, const discrete::SolveOptions& options) {
      return session_.solve(options);
    };
    const auto set_options = [](Arguments& given, const std::atomic<bool>& interrupt) {
      return options_of(given, interrupt);
    };
    return run_solve<Plan>(instance(), arguments, set_options, search);
  }

 private:
  static discrete::Rules rules_of(Timestep robust) {
    discrete::Rules rules;
    rules.robust = robust;
    return rules;
  }
  [[nodiscard]] VertexId vertex(const Ints& place) const {
    return vertex_of(*graph_, place.data(), "place");
  }
  [[nodiscard]] std::optional<VertexId> other(const std::optional<Ints>& place) const {
    return place ? std::optional(vertex(*place)) : std::nullopt;
  }

  std::shared_ptr<Graph> graph_;
  discrete::Session session_;
};

}  // namespace

void bind_step_session(py::module_& module) {
  py::class_<StepSession>(module, "StepSession")
      .def(py::init<std::shared_ptr<Graph>, Timestep, Timestep>())
      .def("add", &StepSession::add)
      .def("change", &StepSession::change)
      .def("remove", &StepSession::remove)
      .def("close", &StepSession::close)
      .def("open", &StepSession::open)
      .def("advance_to", &StepSession::advance_to)
      .def_property_readonly("now", &StepSession::now)
      .def_property_readonly("members", &StepSession::members)
      .def("instance", &StepSession::instance)
      .def("solve", &StepSession::solve);
}

}  // namespace quadrille::python
