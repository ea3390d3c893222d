// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asked/track_recorder.hpp"
#include "frame/input_options.hpp"
#include "quadrille/execution/precedences.hpp"

namespace quadrille::cli {

using execution::Ticks;

/// What the commands about the execution of a plan have in common on the command line.
struct ExecutionArguments {
  InputOptions input;
  RoadmapOptions roadmap;
  std::string plan;
  PlanFormats format;
  std::string json;
  bool quiet = false;
};

/// Sees the clocks run, and keeps what there is to report of it.
class ContactWatch {
 public:
  virtual ~ContactWatch() = default;
  virtual void add(std::span<const Ticks> before, std::span<const Ticks> after) = 0;
  /// Pairs of agents that collided.
  [[nodiscard]] virtual std::size_t contacts() const = 0;
  /// In the input's unit of length; nothing where there are no lengths, or fewer than two agents.
  [[nodiscard]] virtual std::optional<double> clearance() const = 0;
};

/// A plan that is to be executed, of either domain.
struct ExecutionCase {
  std::string description;  ///< The first lines of the human output.
  execution::Precedences order;
  double tick = 1;  ///< Its size in the input's unit of time.
  bool has_timesteps = false;
  std::function<std::string(VertexId)> place;
  std::function<std::unique_ptr<ContactWatch>()> watch;
  /// Where a vertex is on the page, and the page of what agents did, in its ticks; null where
  /// vertices have no places.
  std::function<TrackRecorder::Place(VertexId)> position = {};
  std::function<std::string(const std::vector<view::Track>&)> page = {};
  std::int64_t page_ticks = 1;  ///< Of the page, in one tick.
  std::vector<VertexId> starts = {};

  /// A time in the input's unit, as short as it can be.
  [[nodiscard]] std::string time(Ticks ticks) const {
    return fmt::format("{:.6g}", static_cast<double>(ticks.value()) * tick);
  }
};

}  // namespace quadrille::cli
