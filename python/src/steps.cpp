// SPDX-License-Identifier: MIT
// The discrete domain: graphs, tasks and plans in timesteps.
#include "steps.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "quadrille/discrete/instance_json.hpp"
#include "quadrille/discrete/instance_yaml.hpp"
#include "quadrille/discrete/plan_formats.hpp"
#include "quadrille/discrete/solver.hpp"
#include "quadrille/discrete/verify.hpp"
#include "saving.hpp"
#include "solving.hpp"

namespace quadrille::python {
namespace {

using discrete::Graph;
using discrete::Instance;
using discrete::Plan;

std::shared_ptr<Graph> grid_of(const Bools& free) {
  const auto width = static_cast<std::int32_t>(free.shape(1));
  const auto height = static_cast<std::int32_t>(free.shape(0));
  return std::make_shared<Graph>(Graph::grid(width, height, flags_of(free)));
}

std::shared_ptr<Graph> graph_of(std::size_t num_vertices, const Ints& edges) {
  const auto ends = edges.unchecked<2>();
  const auto vertex = [&](std::int64_t v) {
    if (v < 0 || v >= static_cast<std::int64_t>(num_vertices))
      refuse("edges: there is no vertex " + std::to_string(v) + " among " +
             std::to_string(num_vertices));
    return VertexId(static_cast<std::size_t>(v));
  };
  std::vector<Graph::Edge> list;
  for (py::ssize_t e = 0; e < ends.shape(0); ++e)
    list.emplace_back(vertex(ends(e, 0)), vertex(ends(e, 1)));
  return std::make_shared<Graph>(take(Graph::make(num_vertices, list)));
}

py::array free_cells(const Graph& graph) {
  const auto& layout = *graph.layout();
  const auto height = static_cast<std::size_t>(layout.height());
  const auto width = static_cast<std::size_t>(layout.width());
  auto array = new_array<bool>({height, width});
  auto cells = array.mutable_unchecked<2>();
  for (std::int32_t y = 0; y < layout.height(); ++y)
    for (std::int32_t x = 0; x < layout.width(); ++x)
      cells(y, x) = layout.vertex_at({x, y}).has_value();
  return frozen(array);
}

py::array edges_of(const Graph& graph) {
  auto array = new_array<std::int32_t>({graph.num_edges(), 2});
  auto ends = array.mutable_unchecked<2>();
  py::ssize_t row = 0;
  for (const VertexId v : IdRange<VertexId>(graph.num_vertices()))
    for (const VertexId w : graph.neighbours(v)) {
      if (w < v && !graph.is_directed()) continue;
      ends(row, 0) = static_cast<std::int32_t>(v.index());
      ends(row++, 1) = static_cast<std::int32_t>(w.index());
    }
  return frozen(array);
}

}  // namespace

VertexId vertex_of(const Graph& graph, const std::int64_t* place, const std::string& name) {
  if (!graph.layout()) {
    if (place[0] < 0 || place[0] >= static_cast<std::int64_t>(graph.num_vertices()))
      refuse(name + ": there is no vertex " + std::to_string(place[0]) + " among " +
             std::to_string(graph.num_vertices()));
    return VertexId(static_cast<std::size_t>(place[0]));
  }
  const auto is_int = [](std::int64_t v) { return v >= INT32_MIN && v <= INT32_MAX; };
  const auto vertex = is_int(place[0]) && is_int(place[1])
                          ? graph.layout()->vertex_at({static_cast<std::int32_t>(place[0]),
                                                       static_cast<std::int32_t>(place[1])})
                          : std::nullopt;
  if (!vertex)
    refuse(name + ": the cell (" + std::to_string(place[0]) + ", " + std::to_string(place[1]) +
           ") is blocked, or outside of the grid");
  return *vertex;
}

std::size_t place_size(const Graph& graph) { return graph.layout() ? 2 : 1; }

void write_place(const Graph& graph, VertexId v, std::int32_t* place) {
  if (const auto& layout = graph.layout()) {
    place[0] = layout->cell_of(v).x;
    place[1] = layout->cell_of(v).y;
  } else {
    place[0] = static_cast<std::int32_t>(v.index());
  }
}

namespace {

/// int32[n, 2] on grids, int32[n] otherwise.
template <class VertexOf>
py::array places(const Graph& graph, std::size_t n, const VertexOf& vertex) {
  auto array = graph.layout() ? new_array<std::int32_t>({n, 2}) : new_array<std::int32_t>({n});
  std::int32_t* place = array.mutable_data();
  for (std::size_t i = 0; i < n; ++i, place += place_size(graph))
    write_place(graph, vertex(i), place);
  return frozen(array);
}

/// As Instance::make says it, with names. `ends`: where each agent begins, or the sets of goals.
void refuse_shared(const Graph& graph, const std::vector<Goals>& ends, const std::string& what,
                   const std::vector<std::string>& names) {
  std::map<VertexId, std::size_t> owner;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!ends[i].is_single()) continue;
    if (const auto [at, is_new] = owner.try_emplace(ends[i].only(), i); !is_new)
      raise({ErrorCode::invalid_instance,
             names[at->second] + " and " + names[i] + " have the same " + what + " " +
                 vertex_name(graph, ends[i].only()),
             {}});
  }
}

/// `goals`: those of the first agent, then those of the next one; `num_goals`: how many each has.
/// `names`: what agents are called in messages, or none. `now`: as in Instance::make. `rules`: per
/// agent "releases", "deadlines", -1 for none, and "leaves"; and "robust".
Instance instance_of(const std::shared_ptr<Graph>& graph, const Ints& starts, const Ints& goals,
                     const std::vector<std::size_t>& num_goals,
                     const std::vector<std::string>& names, std::int64_t now,
                     const py::dict& rules) {
  if (now < 0 || now > discrete::kMaxNow)
    refuse("now: the fleet begins at timestep " + std::to_string(now) + ", not 0 .. " +
           std::to_string(discrete::kMaxNow));
  std::vector<discrete::Agent> agents;
  const auto releases = rules["releases"].cast<Ints>(), deadlines = rules["deadlines"].cast<Ints>();
  const auto leaves = rules["leaves"].cast<Bools>();
  const auto timestep = [](std::int64_t t, const std::string& name) {
    if (t < 0 || t > INT32_MAX)
      refuse(name + " of " + std::to_string(t) + " is no timestep from 0 to 2^31 - 1");
    return static_cast<Timestep>(t);
  };
  const std::size_t size = place_size(*graph);
  const std::int64_t* goal = goals.data();
  for (std::size_t i = 0; i < static_cast<std::size_t>(starts.shape(0)); ++i) {
    const std::string agent = i < names.size() ? names[i] : "agent " + std::to_string(i);
    const VertexId start = vertex_of(*graph, starts.data() + size * i, agent + ": start");
    std::vector<VertexId> set;
    for (std::size_t k = 0; k < num_goals[i]; ++k, goal += size)
      set.push_back(vertex_of(*graph, goal, agent + ": goal"));
    if (set.empty()) refuse(agent + " has no goal");
    discrete::Agent& made = agents.emplace_back(discrete::Agent{start, Goals(std::move(set))});
    made.release = timestep(releases.data()[i], agent + ": a release");
    if (deadlines.data()[i] != -1)
      made.deadline = timestep(deadlines.data()[i], agent + ": a deadline");
    made.leaves = leaves.data()[i];
  }
  discrete::Rules all;
  all.robust = timestep(rules["robust"].cast<std::int64_t>(), "robust: a distance");
  auto instance = Instance::make(graph, agents, static_cast<Timestep>(now), std::move(all));
  if (!instance && names.size() == agents.size()) {
    std::vector<Goals> begins, ends;
    for (const discrete::Agent& agent : agents) {
      begins.emplace_back(agent.start);
      // Those of agents that leave may be shared.
      ends.push_back(agent.leaves ? Goals(std::vector<VertexId>()) : agent.goals);
    }
    refuse_shared(*graph, begins, "start", names);
    refuse_shared(*graph, ends, "goal", names);
  }
  return take(std::move(instance));
}

py::dict rules_of(const Instance& instance) {
  const std::size_t n = instance.num_agents();
  auto releases = new_array<double>({n}), deadlines = new_array<double>({n});
  auto leaves = new_array<bool>({n});
  for (const AgentId i : instance.agent_ids()) {
    const discrete::Agent& agent = instance.agents()[i];
    releases.mutable_data()[i.index()] = agent.release;
    deadlines.mutable_data()[i.index()] =
        agent.deadline ? *agent.deadline : std::numeric_limits<double>::quiet_NaN();
    leaves.mutable_data()[i.index()] = agent.leaves;
  }
  py::dict rules;
  rules["releases"] = frozen(releases);
  rules["deadlines"] = frozen(deadlines);
  rules["leaves"] = frozen(leaves);
  rules["robust"] = instance.rules().robust;
  return rules;
}

/// int32[n, T, 2] on grids, int32[n, T] otherwise; T - 1 is the makespan.
py::array paths_of(const Plan& plan, const Graph& graph) {
  std::size_t length = 1;
  for (const auto& path : plan.paths) length = std::max(length, path.size());
  const std::size_t n = plan.paths.size(), size = place_size(graph);
  auto array = graph.layout() ? new_array<std::int32_t>({n, length, 2})
                              : new_array<std::int32_t>({n, length});
  std::int32_t* place = array.mutable_data();
  for (const auto& path : plan.paths)
    for (std::size_t t = 0; t < length; ++t, place += size)
      write_place(graph, t < path.size() ? path[t] : path.back(), place);
  return frozen(array);
}

Plan plan_of(const Graph& graph, const Ints& paths) {
  const auto n = static_cast<std::size_t>(paths.shape(0));
  const auto length = static_cast<std::size_t>(paths.shape(1));
  Plan plan;
  const std::int64_t* place = paths.data();
  for (std::size_t i = 0; i < n; ++i) {
    discrete::Path path;
    for (std::size_t t = 0; t < length; ++t, place += place_size(graph))
      path.push_back(vertex_of(graph, place,
                               "agent " + std::to_string(i) + ", timestep " + std::to_string(t)));
    plan.paths.push_back(std::move(path));
  }
  trim(plan);
  return plan;
}

}  // namespace

discrete::SolveOptions options_of(Arguments& arguments, const std::atomic<bool>& interrupt) {
  discrete::SolveOptions options;
  set_common(arguments, options, interrupt);
  arguments.choose("system", discrete::parse_system, options.system,
                   "dpll, dpll-mdd, smt-cbs or mdd-sat");
  arguments.choose("cost_search", discrete::parse_cost_search, options.cost_search,
                   "iterative or core-guided");
  arguments.choose("mdd_growth", discrete::parse_mdd_growth, options.mdd.growth,
                   "on-demand or full");
  arguments.choose("tie", discrete::parse_tie, options.tie, "any or fewest-moves");
  if (const auto text = arguments.take<std::string>("check"))
    options.mdd.check = take(discrete::parse_check_schedule(*text));
  arguments.set("initial", options.initial_plan);
  arguments.set("known_bound", options.known_lower_bound);
  arguments.set("forbid_first", options.lazy.forbid_first);
  arguments.set("chronological", options.lazy.chronological);
  arguments.set("first_plan", options.first_plan);
  arguments.finish("timesteps");
  return options;
}

namespace {

py::dict solve_steps(const Instance& instance, const py::dict& arguments) {
  return run_solve<Plan>(instance, arguments,
                         [](Arguments& given, const std::atomic<bool>& interrupt) {
                           return options_of(given, interrupt);
                         });
}

/// (violations, sum of costs, makespan); a violation is (kind, agent, other, timestep, message).
py::tuple verify_steps(const Instance& instance, const Plan& plan) {
  discrete::VerifyReport report;
  {
    const py::gil_scoped_release release;
    report = verify(instance, plan);
  }
  py::list violations;
  for (const discrete::Violation& violation : report.violations)
    violations.append(py::make_tuple(
        to_string(violation.kind), violation.agent.index(),
        violation.other ? py::object(py::int_(violation.other->index())) : py::object(py::none()),
        violation.timestep, violation.message));
  return py::make_tuple(violations, report.sum_of_costs, report.makespan);
}

std::optional<discrete::PlanFormat> format_of(const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  const auto format = discrete::parse_plan_format(*name);
  if (!format)
    refuse("format: '" + *name + "' is not json, cbsh2, lns2, visualizer, lacam or yaml");
  return format;
}

void save_plan(const Plan& plan, const Instance& instance, const std::filesystem::path& path,
               const std::optional<std::string>& name) {
  const auto format = format_for(path, format_of(name), discrete::plan_format_of(path),
                                 "json, cbsh2, lns2, visualizer, lacam or yaml");
  save(path, [&](std::ostream& out) {
    return write_plan(out, path.string(), instance.graph(), plan, format);
  });
}

Plan read_plan(const Instance& instance, const std::filesystem::path& path,
               const std::optional<std::string>& name) {
  const auto format = format_of(name);
  return take([&] {
           const py::gil_scoped_release release;
           return discrete::read_plan(path, instance, format);
         }())
      .plan;
}

void save_instance(const Instance& instance, const std::filesystem::path& path,
                   const std::optional<std::string>& name, const NameLists& lists) {
  using discrete::PlanFormat;
  const auto named = name ? discrete::parse_plan_format(*name) : std::nullopt;
  if (name && named != PlanFormat::json && named != PlanFormat::yaml)
    refuse("format: '" + *name + "' is not json or yaml");
  const auto format = format_for(path, named, discrete::plan_format_of(path), "json or yaml");
  text::Names names = names_of(lists);
  names.agents.resize(instance.num_agents());
  // Without a name an agent is called agent0 in YAML, and 0 in Python.
  if (format == PlanFormat::yaml)
    for (std::size_t i = 0; i < names.agents.size(); ++i)
      if (!names.agents[i]) names.agents[i] = std::to_string(i);
  save(path, [&](std::ostream& out) {
    return format == PlanFormat::yaml ? write_instance_yaml(out, path.string(), instance, names)
                                      : write_instance_json(out, path.string(), instance, names);
  });
}

/// int64[n], -1 where the goal is out of reach.
py::array free_costs_of(const Instance& instance) {
  auto costs = new_array<std::int64_t>({instance.num_agents()});
  std::int64_t* to = costs.mutable_data();
  for (const discrete::Agent& agent : instance.agents()) {
    const auto cost = distances_to_nearest(instance.graph(), agent.goals)[agent.start];
    *to++ = cost == discrete::kUnreachable ? -1 : cost;
  }
  return frozen(costs);
}

/// The text of an instance file.
py::bytes state_of(const Instance& instance) {
  std::ostringstream text;
  text::Names names;
  check(write_instance_json(text, "", instance, names));
  return text.str();
}
Instance instance_of_state(const py::bytes& state) {
  std::istringstream in{std::string(state)};
  return take(discrete::read_instance_json(in, "a pickled fleet"));
}

/// The same without agents.
py::bytes state_of_graph(const std::shared_ptr<Graph>& graph) {
  return state_of(take(Instance::make(graph, {})));
}
std::shared_ptr<Graph> graph_of_state(const py::bytes& state) {
  return std::const_pointer_cast<Graph>(instance_of_state(state).shared_graph());
}

/// (now, int64[k] per agent).
py::tuple state_of_plan(const Plan& plan) {
  py::list paths;
  for (const discrete::Path& path : plan.paths) {
    auto places = new_array<std::int64_t>({path.size()});
    std::transform(path.begin(), path.end(), places.mutable_data(),
                   [](VertexId v) { return static_cast<std::int64_t>(v.index()); });
    paths.append(places);
  }
  return py::make_tuple(plan.now, paths);
}
Plan plan_of_state(const py::tuple& state) {
  Plan plan;
  plan.now = state[0].cast<Timestep>();
  for (const py::handle entry : state[1].cast<py::list>()) {
    const auto places = entry.cast<Ints>();
    discrete::Path path;
    for (py::ssize_t t = 0; t < places.size(); ++t)
      path.emplace_back(static_cast<std::size_t>(places.at(t)));
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

}  // namespace

void bind_steps(py::module_& module) {
  py::class_<Graph, std::shared_ptr<Graph>>(module, "StepGraph")
      .def_static("grid", &grid_of)
      .def_static("make", &graph_of)
      .def_property_readonly("is_grid", [](const Graph& graph) { return bool(graph.layout()); })
      .def_property_readonly("num_vertices", &Graph::num_vertices)
      .def_property_readonly("num_edges", &Graph::num_edges)
      .def("free", &free_cells)
      .def("edges", &edges_of)
      .def(py::pickle(&state_of_graph, &graph_of_state));
  py::class_<Plan>(module, "StepPlan")
      .def_property_readonly("num_agents", [](const Plan& plan) { return plan.paths.size(); })
      .def_readonly("now", &Plan::now)
      .def("costs",
           [](const Plan& plan) {
             auto costs = new_array<std::int64_t>({plan.paths.size()});
             std::transform(plan.paths.begin(), plan.paths.end(), costs.mutable_data(),
                            &discrete::arrival);
             return frozen(costs);
           })
      .def("paths", &paths_of)
      .def("save", &save_plan)
      .def(py::pickle(&state_of_plan, &plan_of_state));
  py::class_<Instance>(module, "StepInstance")
      .def(py::init(&instance_of))
      .def_property_readonly("num_agents", &Instance::num_agents)
      .def_property_readonly("now", &Instance::now)
      .def("rules", &rules_of)
      .def_property_readonly("graph",
                             [](const Instance& instance) {
                               // Nobody on this side can change it.
                               return std::const_pointer_cast<Graph>(instance.shared_graph());
                             })
      .def("starts",
           [](const Instance& instance) {
             return places(instance.graph(), instance.num_agents(),
                           [&](std::size_t i) { return instance.agents()[AgentId(i)].start; });
           })
      .def("goals",
           [](const Instance& instance) {
             return places(instance.graph(), instance.num_agents(),
                           [&](std::size_t i) { return instance.agents()[AgentId(i)].goal(); });
           })
      .def("goal_sets",
           [](const Instance& instance) {
             py::list sets;
             for (const discrete::Agent& agent : instance.agents()) {
               const auto goals = agent.goals.vertices();
               sets.append(
                   places(instance.graph(), goals.size(), [&](std::size_t k) { return goals[k]; }));
             }
             return sets;
           })
      .def("has_goal_sets", &Instance::has_goal_sets)
      .def("plan",
           [](const Instance& instance, const Ints& paths) {
             Plan plan = plan_of(instance.graph(), paths);
             plan.now = instance.now();
             return plan;
           })
      .def("free_costs", &free_costs_of)
      .def("solve", &solve_steps)
      .def("verify", &verify_steps)
      .def("read_plan", &read_plan)
      .def("save", &save_instance)
      .def(py::pickle(&state_of, &instance_of_state));
}

}  // namespace quadrille::python
