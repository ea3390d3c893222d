// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::cli {

/// What plans on roadmaps are exported to for other systems; docs/formats-of-others.md has the
/// fields.
enum class ExportFormat {
  csv,       ///< agent,time,x,y,vx,vy: samples.
  multidof,  ///< trajectory_msgs/MultiDOFJointTrajectory, one message per agent, as JSON.
  path,      ///< nav_msgs/Path, one message per agent, as JSON.
  vda5050,   ///< VDA 5050 orders, one per agent, as JSON.
  planviz,   ///< What PlanViz shows: an action per timestep of robots on a grid that turn.
};
[[nodiscard]] std::optional<ExportFormat> parse_export_format(std::string_view text) noexcept;

/// The plan at `rate` samples per unit of time, at both ends of each move, and at the end of the
/// path. Not for vda5050 and planviz. Requires a valid plan.
[[nodiscard]] std::string export_samples(const continuous::Instance& instance,
                                         const continuous::Plan& plan, ExportFormat format,
                                         double rate);
/// One order per agent, in which what can be released at the start is released.
[[nodiscard]] std::string export_orders(const continuous::Instance& instance,
                                        const continuous::Plan& plan,
                                        const execution::Precedences& order);

/// How robots that follow the orders end up waiting for each other for ever: who waits where for
/// whom, in the names of the orders, one line for each. Empty if all arrive.
[[nodiscard]] std::vector<std::string> describe_lock_up(const execution::Precedences& order);

/// What of an order has been released: the order begins with the node `first` of the path, and ends
/// its base with the node `released`.
struct OrderState {
  std::uint32_t first = 0, released = 0, update = 0;
};
/// One order of one agent, without the end of the line.
[[nodiscard]] std::string export_order(const continuous::Instance& instance, AgentId agent,
                                       const continuous::Path& path, const OrderState& state);
/// The agent's serialNumber and orderId.
[[nodiscard]] std::string order_name(AgentId agent);

}  // namespace quadrille::cli
