// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/dispatch/dispatcher.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

/// Where a robot is, in length units.
struct Place {
  double x = 0, y = 0, z = 0;
};

struct SimulationOptions {
  Ticks step = 1;                ///< Time from one call to the next; at least 1.
  double pause_chance = 0;       ///< That a robot which goes on pauses, per step; 0 .. 1.
  Ticks longest_pause = 1;       ///< At least 1; the shortest takes 1.
  Ticks service = 0;             ///< Of random tasks.
  bool has_random_tasks = true;  ///< Whoever has none gets another one, at any vertex.
  std::uint64_t seed = 0;
  /// Instead of random tasks: what somebody who has none has to do next, one after the other; an
  /// empty list: nothing now. Each has to be one that the dispatcher takes.
  std::function<std::vector<Task>(AgentId)> next_tasks = {};
  /// Hears, in order of time, where everybody is; between two calls all go straight and evenly.
  std::function<void(Ticks, const std::vector<Place>&)> watch = {};
};

/// Robots that obey a dispatcher, are held up at random, and get tasks at random. All that is drawn
/// is the same on every platform. One thread at a time.
class Simulation {
 public:
  /// `roadmap`: of the dispatcher, which outlives this; robots as it was made with.
  Simulation(Dispatcher& dispatcher, std::shared_ptr<const continuous::Roadmap> roadmap,
             std::vector<continuous::Agent> robots, const SimulationOptions& options);

  /// A call of the dispatcher, and the time until the next one.
  News step(const Limits& limits = {});

  /// Between assignment and end of each task that is done, in order.
  [[nodiscard]] const std::vector<Ticks>& service_times() const noexcept { return service_times_; }
  /// Pairs of robots whose bodies overlapped, as often as somebody began or ended a stay
  /// or a move meanwhile, by their places alone; of discs only. Anything but 0 is a defect.
  [[nodiscard]] std::size_t num_contacts() const noexcept { return num_contacts_; }
  /// Since it began.
  [[nodiscard]] Ticks time() const noexcept { return time_; }

 private:
  struct Pause {
    Ticks from = 0, until = 0;
  };
  void ask_for_tasks();
  void draw_tasks();
  void draw_pauses();
  [[nodiscard]] bool goes(std::size_t robot) const;
  void go_on(Ticks end);
  void look();
  [[nodiscard]] Place place(std::size_t robot) const;

  Dispatcher& dispatcher_;
  const std::shared_ptr<const continuous::Roadmap> roadmap_;
  const SimulationOptions options_;
  Random random_;
  std::vector<continuous::Agent> robots_;
  std::vector<double> radii_;
  std::vector<bool> are_discs_;
  std::vector<Ticks> clocks_;
  std::vector<Pause> pauses_;
  std::vector<std::vector<Ticks>> since_;  // of the tasks of each robot, in order
  std::vector<Place> before_;
  std::vector<Ticks> service_times_;
  std::size_t num_contacts_ = 0;
  Ticks time_ = 0;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
