// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "dispatch/referee.hpp"
#include "quadrille/dispatch/dispatcher.hpp"
#include "support/random.hpp"

namespace quadrille::dispatch::test {

struct Delays {
  int pause_percent = 0;      ///< Of the ticks on which a robot that goes stops.
  int longest_pause = 1;      ///< Ticks.
  std::vector<Ticks> breaks;  ///< By robot: when it stops for ever; missing or negative: never.
};

/// Robots that obey their dispatcher: they go along their courses as far as they are allowed, and
/// are held up at random. A referee watches every tick.
class SimulatedFleet {
 public:
  SimulatedFleet(std::shared_ptr<const continuous::Roadmap> roadmap,
                 std::vector<continuous::Agent> robots, const Options& options, Delays delays,
                 std::uint64_t seed);

  Dispatcher& dispatcher() { return dispatcher_; }
  /// One call, and the time that it is for.
  News step(Ticks duration, const Limits& limits = {});
  [[nodiscard]] const Referee& referee() const { return referee_; }
  [[nodiscard]] bool is_broken(AgentId robot) const;
  /// Steps since the robot has been where it is.
  [[nodiscard]] std::size_t idle(AgentId robot) const { return idle_[robot.index()]; }

 private:
  [[nodiscard]] Place place(AgentId robot, Ticks clock) const;

  std::shared_ptr<const continuous::Roadmap> roadmap_;
  Dispatcher dispatcher_;
  Delays delays_;
  support::Random random_;
  Referee referee_;
  std::vector<Ticks> clocks_, paused_until_;
  std::vector<std::size_t> idle_;
  Ticks time_ = 0;
};

}  // namespace quadrille::dispatch::test
