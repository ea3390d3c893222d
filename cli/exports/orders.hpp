// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::cli {

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
