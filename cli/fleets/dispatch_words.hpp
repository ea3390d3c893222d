// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "fleets/live_fleet.hpp"
#include "quadrille/core/ids.hpp"
#include "quadrille/core/result.hpp"
#include "quadrille/dispatch/course.hpp"
#include "quadrille/text/names.hpp"

namespace quadrille::cli {

/// Robots, vertices and times as those say them who are served: names where there are any, else
/// numbers; times in the unit of the input.
class DispatchWords {
 public:
  using Json = nlohmann::ordered_json;
  using Ticks = dispatch::Ticks;

  /// Keeps references to both.
  DispatchWords(const LiveFleet& fleet, const text::Names& names);

  // Of requests. Errors (invalid_instance, out_of_range) say what there is not.
  [[nodiscard]] Result<AgentId> robot(const Json& called) const;
  [[nodiscard]] Result<VertexId> vertex(const Json& called) const;
  /// Rounded up, or down, to a whole tick. `what`: for messages.
  [[nodiscard]] Result<Ticks> ticks(const Json& time, const std::string& what, bool is_up) const;

  // Of answers.
  [[nodiscard]] Json robot(AgentId robot) const;
  [[nodiscard]] Json vertex(VertexId vertex) const;
  [[nodiscard]] double time(Ticks ticks) const;
  /// {vertex, arrive, depart}, within a lane also {to, fraction}.
  [[nodiscard]] Json stop(const dispatch::Stop& stop) const;
  /// [x, y] in float32, of a place on a lane too; [] on a graph without places.
  [[nodiscard]] Json position(const dispatch::Spot& spot) const;
  /// In messages of Open-RMF: of a robot without a name "agent3".
  [[nodiscard]] std::string participant(AgentId robot) const;

 private:
  const LiveFleet& fleet_;
  const text::Names& names_;
  std::map<std::string, AgentId> robots_;
  std::map<Json, VertexId> vertices_;
};

}  // namespace quadrille::cli
