// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "quadrille/core/export.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/dispatch/dispatcher.hpp"
#include "quadrille/dispatch/task_feed.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::dispatch {

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
  [[nodiscard]] const std::vector<Ticks>& service_times() const noexcept {
    return feed_.service_times();
  }
  /// Pairs of robots whose bodies overlapped, as often as somebody began or ended a stay
  /// or a move meanwhile, by their places alone; of discs only. Anything but 0 is a defect.
  [[nodiscard]] std::size_t num_contacts() const noexcept { return num_contacts_; }
  /// Since it began.
  [[nodiscard]] Ticks time() const noexcept { return time_; }

 private:
  struct Pause {
    Ticks from = 0, until = 0;
  };
  void draw_pauses();
  [[nodiscard]] bool goes(std::size_t robot) const;
  void go_on(Ticks end);
  void look();
  [[nodiscard]] Place place(std::size_t robot) const;

  Dispatcher& dispatcher_;
  const std::shared_ptr<const continuous::Roadmap> roadmap_;
  const SimulationOptions options_;
  Random random_;
  TaskFeed feed_;
  std::vector<continuous::Agent> robots_;
  std::vector<double> radii_;
  std::vector<bool> are_discs_;
  std::vector<Ticks> clocks_;
  std::vector<Pause> pauses_;
  std::vector<Place> before_;
  std::size_t num_contacts_ = 0;
  Ticks time_ = 0;
};

}  // namespace quadrille::dispatch

QUADRILLE_API_END
