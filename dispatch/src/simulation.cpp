// SPDX-License-Identifier: MIT
#include "quadrille/dispatch/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::dispatch {
namespace {

double number(continuous::Length length) { return static_cast<double>(length.value()); }

/// Places in doubles are off by less than that share of a radius.
constexpr double kTolerance = 1e-9;

}  // namespace

Simulation::Simulation(Dispatcher& dispatcher, std::shared_ptr<const continuous::Roadmap> roadmap,
                       std::vector<continuous::Agent> robots, const SimulationOptions& options)
    : dispatcher_(dispatcher),
      roadmap_(std::move(roadmap)),
      options_(options),
      random_(options.seed),
      feed_(
          options, dispatcher.num_robots(), roadmap_->num_vertices(),
          [&dispatcher](AgentId robot, const Task& task) { return dispatcher.assign(robot, task); },
          [&dispatcher](AgentId robot) { return dispatcher.num_tasks(robot); }, 0),
      robots_(std::move(robots)),
      clocks_(robots_.size(), 0),
      pauses_(robots_.size()) {
  QUADRILLE_REQUIRE(robots_.size() == dispatcher.num_robots(), "the robots of the dispatcher");
  QUADRILLE_REQUIRE(options.step >= 1 && options.longest_pause >= 1, "at least one tick");
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    radii_.push_back(number(geometry::enclosing_radius(robots_[i].body)));
    are_discs_.push_back(std::holds_alternative<continuous::Disc>(robots_[i].body));
    clocks_[i] = dispatcher.clock(AgentId(i));
  }
}

News Simulation::step(const Limits& limits) {
  feed_.feed(time_, random_);
  for (std::size_t i = 0; i < robots_.size(); ++i)
    QUADRILLE_REQUIRE(!dispatcher_.report(AgentId(i), clocks_[i]), "a robot that obeys");
  News news = dispatcher_.tick(options_.step, limits);
  for (std::size_t i = 0; i < robots_.size(); ++i) clocks_[i] = dispatcher_.clock(AgentId(i));
  if (before_.empty()) look();
  feed_.finish(news.served, time_);
  draw_pauses();
  const Ticks end = time_ + options_.step;
  while (time_ < end) {
    go_on(end);
    look();
  }
  return news;
}

void Simulation::draw_pauses() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (time_ < pauses_[i].until || clocks_[i] >= dispatcher_.limit(AgentId(i))) continue;
    if (random_.below(1'000'000) >= static_cast<std::uint64_t>(1e6 * options_.pause_chance))
      continue;
    pauses_[i].from = time_ + drawn(random_, options_.step);
    pauses_[i].until = pauses_[i].from + 1 + drawn(random_, options_.longest_pause);
  }
}

bool Simulation::goes(std::size_t robot) const {
  const bool pauses = pauses_[robot].from <= time_ && time_ < pauses_[robot].until;
  return !pauses && clocks_[robot] < dispatcher_.limit(AgentId(robot));
}

/// To where somebody begins or ends a pause, a stay or a move, or may go no further, so that all
/// go straight and evenly until then.
void Simulation::go_on(Ticks end) {
  Ticks next = end;
  const auto happens = [&](Ticks time) {
    if (time > time_) next = std::min(next, time);
  };
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    happens(pauses_[i].from);
    happens(pauses_[i].until);
    if (!goes(i)) continue;
    const Ticks left = time_ - clocks_[i];
    happens(left + dispatcher_.limit(AgentId(i)));
    for (const Stop& stop : dispatcher_.course(AgentId(i))) {
      happens(left + stop.arrive);
      happens(left + stop.depart);
    }
  }
  for (std::size_t i = 0; i < robots_.size(); ++i)
    if (goes(i)) clocks_[i] += next - time_;
  time_ = next;
}

Place Simulation::place(std::size_t robot) const {
  const Spot spot = spot_at(dispatcher_.course(AgentId(robot)), clocks_[robot]);
  const continuous::Point &from = roadmap_->position(spot.from), &to = roadmap_->position(spot.to);
  const double share =
      static_cast<double>(spot.behind.value()) / static_cast<double>(spot.whole.value());
  const auto at = [&](continuous::Length a, continuous::Length b) {
    return number(a) + share * number(b - a);
  };
  return {at(from.x, to.x), at(from.y, to.y), at(from.z, to.z)};
}

// Since the last look everybody has gone straight and evenly.
void Simulation::look() {
  std::vector<Place> after;
  for (std::size_t i = 0; i < robots_.size(); ++i) after.push_back(place(i));
  if (before_.empty()) before_ = after;
  std::vector<std::size_t> order(robots_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto left = [&](std::size_t i) { return std::min(before_[i].x, after[i].x) - radii_[i]; };
  const auto right = [&](std::size_t i) { return std::max(before_[i].x, after[i].x) + radii_[i]; };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::pair(left(i), i) < std::pair(left(j), j);
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t l = k + 1; l < order.size() && left(order[l]) < right(order[k]); ++l) {
      const std::size_t i = order[k], j = order[l];
      if (!are_discs_[i] || !are_discs_[j]) continue;
      const auto apart = [&](const std::vector<Place>& places) {
        return Place{places[j].x - places[i].x, places[j].y - places[i].y,
                     places[j].z - places[i].z};
      };
      const Place from = apart(before_), to = apart(after);
      const Place way{to.x - from.x, to.y - from.y, to.z - from.z};
      const double square = way.x * way.x + way.y * way.y + way.z * way.z;
      const double along = from.x * way.x + from.y * way.y + from.z * way.z;
      const double share = square > 0 ? std::clamp(-along / square, 0.0, 1.0) : 0;
      const double distance =
          std::hypot(from.x + share * way.x, from.y + share * way.y, from.z + share * way.z);
      const double reach = radii_[i] + radii_[j];
      if (distance < reach * (1 - kTolerance) - kTolerance) ++num_contacts_;
    }
  before_ = std::move(after);
  if (options_.watch) options_.watch(time_, before_);
}

}  // namespace quadrille::dispatch
