// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "quadrille/view/page.hpp"

namespace quadrille::cli {

/// Makes tracks of agents that are seen again and again, and go straight and evenly in between.
class TrackRecorder {
 public:
  /// In length units, and degrees as in view::Sight.
  struct Place {
    double x = 0, y = 0, z = 0;
    std::optional<double> heading = {};
  };

  /// Where the agent is at a time, in ticks, not earlier than the last one of this agent.
  void add(std::size_t agent, std::int64_t time, const Place& place);

  [[nodiscard]] const std::vector<view::Track>& tracks() const noexcept { return tracks_; }

 private:
  std::vector<view::Track> tracks_;
};

}  // namespace quadrille::cli
