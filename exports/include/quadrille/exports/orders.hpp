// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/execution/precedences.hpp"
#include "quadrille/exports/naming.hpp"
#include "quadrille/exports/samples.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::exports {

/// A published version of VDA 5050. Of what is written here, 2.0 and 2.1 have `startNodeId` and
/// `endNodeId` of edges, and 3.0 calls `maxSpeed` `maximumSpeed`.
enum class VdaVersion { v2_0, v2_1, v3_0 };
[[nodiscard]] std::optional<VdaVersion> parse_vda_version(std::string_view text) noexcept;

/// What of an order has been released: the order begins with the node `first` of the path, and ends
/// its base with the node `released`.
struct OrderState {
  std::uint32_t first = 0, released = 0, update = 0;
};

/// Writes the orders of a plan.
class OrderWriter {
 public:
  /// `yaws`: of the vertices of robots that turn, or null; then nodes have no headings. Keeps
  /// references to these and the plan.
  OrderWriter(const continuous::Instance& instance, const Yaws* yaws, const continuous::Plan& plan,
              OrderNames names, VdaVersion version)
      : instance_(instance),
        yaws_(yaws),
        plan_(plan),
        names_(std::move(names)),
        version_(version) {}

  /// One order of one agent, without the end of the line.
  [[nodiscard]] std::string order(AgentId agent, const OrderState& state) const;
  /// One order per agent, in which what can be released at the start is released.
  [[nodiscard]] std::string orders(const execution::Precedences& order) const;

  [[nodiscard]] const OrderNames& names() const noexcept { return names_; }

 private:
  const continuous::Instance& instance_;
  const Yaws* yaws_;
  const continuous::Plan& plan_;
  OrderNames names_;
  VdaVersion version_;
};

/// How robots that follow the orders end up waiting for each other for ever: who waits where for
/// whom, in the names of the orders, one line for each. Empty if all arrive.
[[nodiscard]] std::vector<std::string> describe_lock_up(const execution::Precedences& order,
                                                        const OrderNames& names);

}  // namespace quadrille::exports

QUADRILLE_API_END
