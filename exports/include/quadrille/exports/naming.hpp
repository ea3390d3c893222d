// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/text/names.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// What a robot is called by others, per agent.
using RobotNames = IdVector<AgentId, std::string>;

/// Those of the names, "agent3" where there is none. Error (invalid_instance, without a file): two
/// are called alike.
[[nodiscard]] Result<RobotNames> robot_names(const text::Names& names, std::size_t num_agents);

/// Names that whoever receives an export has for things.
struct Naming {
  text::Names names;
  std::string manufacturer = "quadrille", map = "map";
  std::string source;  ///< The file that says so, for errors.
};
/// Those of a text in JSON or YAML (docs/formats-of-others.md), in place of `own`. A
/// list of agents or vertices that is there replaces the other one as a whole. Errors with file and
/// line: those of text::parse_json; syntax and invalid_instance for another
/// form, for more names than there are agents or vertices, and vertices that are called alike.
[[nodiscard]] Result<Naming> parse_naming(std::string_view text, const std::string& file,
                                          Naming own, std::size_t num_agents,
                                          std::size_t num_vertices);

/// The names in the orders of a plan.
struct OrderNames {
  RobotNames robots, orders;
  IdVector<VertexId, std::string> nodes;  ///< Of vertices that the plan goes to; of others empty.
  std::string manufacturer, map;
  std::string time_stamp = "1970-01-01T00:00:00.000Z";  ///< Of all messages.
};
/// Whether it is one as VDA 5050 has them: YYYY-MM-DDTHH:mm:ss.fffZ, with digits that are a time.
[[nodiscard]] bool is_time_stamp(std::string_view text);
/// `order`: the beginning of the ids of orders, which are followed by the robot; empty: they are
/// the names of the robots. Errors (invalid_instance): names of robots that are no serial numbers
/// of VDA 5050 (A-Z a-z 0-9 _ . : -), empty names, two robots or two places of the plan that are
/// called alike; vertices in one place may
/// be. Linear in the plan and the vertices.
[[nodiscard]] Result<OrderNames> order_names(const Naming& naming, const continuous::Plan& plan,
                                             const continuous::Roadmap& roadmap,
                                             const std::string& order);

}  // namespace quadrille::exports

QUADRILLE_API_END
