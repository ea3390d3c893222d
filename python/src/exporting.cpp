// SPDX-License-Identifier: MIT
// Plans for other systems, as text.
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "errors.hpp"
#include "executing.hpp"
#include "quadrille/exports/exports.hpp"
#include "quadrille/exports/orders.hpp"
#include "quadrille/exports/rmf.hpp"
#include "saving.hpp"
#include "timed.hpp"

namespace quadrille::python {
namespace {

/// Where robots face at each vertex.
std::optional<exports::Yaws> yaws_of(const std::optional<Doubles>& given) {
  if (!given) return std::nullopt;
  return exports::Yaws(std::vector<double>(given->data(), given->data() + given->size()));
}

/// A text in the format: csv, multidof or path.
std::string samples_of(const TimedInstance& self, const continuous::Plan& plan,
                       const std::optional<Doubles>& given, const NameLists& names,
                       const std::string& format, double rate, std::int64_t ros) {
  const auto known = exports::parse_export_format(format);
  if (!known) refuse("message: '" + format + "' is not multidof or path");
  if (ros != 1 && ros != 2) refuse("ros: there are ROS 1 and 2");
  const exports::SampleOptions options{*known, rate, static_cast<exports::RosVersion>(ros)};
  check(exports::why_no_samples(self.instance(), plan, options));
  const auto robots = take(exports::robot_names(names_of(names), plan.paths.size()));
  const auto yaws = yaws_of(given);
  const py::gil_scoped_release release;
  return exports::export_samples(self.instance(), yaws ? &*yaws : nullptr, plan, robots, options);
}

/// A text: messages of a plan server of Open-RMF.
std::string rmf_of(const TimedInstance& self, const continuous::Plan& plan,
                   const execution::Precedences& order, const NameLists& names,
                   const std::vector<std::string>& heads, bool allow_cycles) {
  if (!self.instance().roadmap().is_flat())
    refuse("plans of Open-RMF have no heights, and the roadmap has");
  exports::RmfHeads made;
  made.names = names_of(names);
  made.robots = take(exports::robot_names(made.names, plan.paths.size()));
  made.map = heads[0];
  made.graph = heads[1];
  made.session = heads[2];
  const auto cycle = exports::blocked_for_ever(order);
  if (!cycle.empty() && !allow_cycles)
    raise({ErrorCode::invalid_plan,
           "with these blockers robots wait for each other for ever, among them " +
               made.robots[cycle.front().agent] + "; allow_cycles=True writes them all the same",
           {}});
  return exports::export_rmf_plan(self.instance(), plan, order, made);
}

/// What messages say besides the plan.
struct OrderHeads {
  std::string version, manufacturer, map, order, time_stamp;
};

/// JSON texts, one order per agent. Each begins with the node `first` of its path and has as many
/// moves released as `released` says; empty: what can be released at the start.
std::vector<std::string> orders_of(const TimedInstance& self, const continuous::Plan& plan,
                                   const std::optional<Doubles>& given,
                                   const execution::Precedences& order, const NameLists& names,
                                   const OrderHeads& heads,
                                   const std::vector<exports::OrderState>& states,
                                   bool allow_cycles) {
  const auto version = exports::parse_vda_version(heads.version);
  if (!version) refuse("version: '" + heads.version + "' is not 3.0, 2.1 or 2.0");
  if (!exports::is_time_stamp(heads.time_stamp))
    refuse("time_stamp: '" + heads.time_stamp + "' is not YYYY-MM-DDTHH:mm:ss.fffZ");
  if (!self.instance().roadmap().is_flat())
    refuse("orders of VDA 5050 have no heights, and the roadmap has");
  exports::Naming naming;
  naming.names = names_of(names);
  naming.manufacturer = heads.manufacturer;
  naming.map = heads.map;
  auto called = take(exports::order_names(naming, plan, self.instance().roadmap(), heads.order));
  called.time_stamp = heads.time_stamp;
  if (!allow_cycles)
    if (const auto lines = exports::describe_lock_up(order, called); !lines.empty())
      raise({ErrorCode::invalid_plan,
             "with these orders robots wait for ever: " + lines.front() +
                 "; plan with larger bodies or shorter edges, or say allow_cycles=True",
             {}});
  const auto yaws = yaws_of(given);
  const exports::OrderWriter writer(self.instance(), yaws ? &*yaws : nullptr, plan,
                                    std::move(called), *version);
  std::vector<std::string> texts;
  for (const AgentId agent : self.instance().agent_ids())
    texts.push_back(writer.order(agent, states[agent.index()]));
  return texts;
}

}  // namespace

void bind_exporting(py::module_& module) {
  module.def("samples", &samples_of);
  module.def("rmf_plans", &rmf_of);
  module.def("orders", [](const TimedInstance& self, const continuous::Plan& plan,
                          const std::optional<Doubles>& poses, const execution::Precedences& order,
                          const NameLists& names, const std::vector<std::string>& heads,
                          const std::vector<std::uint32_t>& first,
                          const std::vector<std::uint32_t>& released, std::uint32_t update,
                          bool allow_cycles) {
    std::vector<exports::OrderState> states;
    for (std::size_t i = 0; i < first.size(); ++i)
      states.push_back({first[i], released[i], update});
    return orders_of(self, plan, poses, order, names,
                     {heads[0], heads[1], heads[2], heads[3], heads[4]}, states, allow_cycles);
  });
}

}  // namespace quadrille::python
