// SPDX-License-Identifier: MIT
#include "dispatch/simulated_fleet.hpp"

#include <gtest/gtest.h>

#include <variant>

namespace quadrille::dispatch::test {
namespace {

std::vector<double> radii_of(const std::vector<continuous::Agent>& robots) {
  std::vector<double> radii;
  for (const continuous::Agent& robot : robots)
    radii.push_back(static_cast<double>(std::get<continuous::Disc>(robot.body).radius.value()));
  return radii;
}

}  // namespace

SimulatedFleet::SimulatedFleet(std::shared_ptr<const continuous::Roadmap> roadmap,
                               std::vector<continuous::Agent> robots, const Options& options,
                               Delays delays, std::uint64_t seed)
    : roadmap_(roadmap),
      dispatcher_(Dispatcher::make(roadmap, robots, {}, options).value()),
      delays_(std::move(delays)),
      random_(seed),
      referee_(radii_of(robots)),
      clocks_(robots.size(), 0),
      paused_until_(robots.size(), 0),
      idle_(robots.size(), 0) {
  delays_.breaks.resize(robots.size(), -1);
}

bool SimulatedFleet::is_broken(AgentId robot) const {
  const Ticks when = delays_.breaks[robot.index()];
  return when >= 0 && time_ >= when;
}

Place SimulatedFleet::place(AgentId robot, Ticks clock) const {
  const Spot spot = spot_at(dispatcher_.course(robot), clock);
  const auto &from = roadmap_->position(spot.from), &to = roadmap_->position(spot.to);
  const double share =
      static_cast<double>(spot.behind.value()) / static_cast<double>(spot.whole.value());
  const auto between = [&](continuous::Length a, continuous::Length b) {
    return static_cast<double>(a.value()) + share * static_cast<double>((b - a).value());
  };
  return {between(from.x, to.x), between(from.y, to.y)};
}

News SimulatedFleet::step(Ticks duration, const Limits& limits) {
  const std::size_t n = clocks_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto error = dispatcher_.report(AgentId(i), clocks_[i]);
    EXPECT_FALSE(error) << error->message;
  }
  std::vector<Place> before;
  for (std::size_t i = 0; i < n; ++i) before.push_back(place(AgentId(i), clocks_[i]));
  const News news = dispatcher_.tick(duration, limits);
  for (std::size_t i = 0; i < n; ++i) {
    clocks_[i] = dispatcher_.clock(AgentId(i));
    const Place here = place(AgentId(i), clocks_[i]);
    EXPECT_NEAR(here.x, before[i].x, 1e-6) << "robot " << i << " is somewhere else";
    EXPECT_NEAR(here.y, before[i].y, 1e-6) << "robot " << i << " is somewhere else";
  }
  const auto ways = referee_.ways();
  for (Ticks t = 0; t < duration; t += 1, time_ += 1) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < n; ++i) {
      if (time_ >= paused_until_[i] && delays_.pause_percent > 0 &&
          random_.percent(static_cast<std::size_t>(delays_.pause_percent)))
        paused_until_[i] = time_ + 1 +
                           Ticks(static_cast<std::int64_t>(
                               random_.below(static_cast<std::size_t>(delays_.longest_pause))));
      const bool may = clocks_[i] < dispatcher_.limit(AgentId(i));
      if (may && time_ >= paused_until_[i] && !is_broken(AgentId(i))) clocks_[i] += 1;
      places.push_back(place(AgentId(i), clocks_[i]));
    }
    referee_.look(places);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const bool has_moved = !ways.empty() && referee_.ways()[i] > ways[i];
    idle_[i] = has_moved ? 0 : idle_[i] + 1;
  }
  return news;
}

}  // namespace quadrille::dispatch::test
