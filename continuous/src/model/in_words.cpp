// SPDX-License-Identifier: MIT
#include "quadrille/continuous/in_words.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "model/obstacle_leg.hpp"
#include "model/place_of_rest.hpp"
#include "model/shapes.hpp"
#include "quadrille/continuous/free_cost.hpp"
#include "quadrille/continuous/quantise.hpp"
#include "quadrille/geometry/body_index.hpp"

namespace quadrille::continuous {
namespace {

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }
Error no_plan(const std::string& message) { return {ErrorCode::no_plan, message, {}}; }

/// Finds again what is wrong: Instance::make has numbers only.
class Finder {
 public:
  Finder(const std::shared_ptr<const Roadmap>& roads, const std::vector<Agent>& agents,
         const Resolution& resolution, const std::vector<MovingObstacle>& obstacles, Ticks now,
         const Words& words)
      : roads_(roads),
        agents_(agents),
        resolution_(resolution),
        obstacles_(obstacles),
        now_(now),
        words_(words) {}

  [[nodiscard]] std::optional<Error> find() const {
    if (auto found = find_polygon_in_space()) return found;
    if (auto found = find_unsupported()) return found;
    if (auto found = find_waiting()) return found;
    const auto start = [](const Agent& agent) { return &agent.start; };
    const auto parks = [](const Agent& agent) { return agent.overlaps_at_start; };
    const auto never = [](const Agent&) { return false; };
    if (auto found = find_overlap(start, parks, "starts")) return found;
    if (auto found = find_overlap(place_of_rest, never, "goals")) return found;
    if (auto found = find_obstacle()) return found;
    for (std::size_t i = 0; i < agents_.size(); ++i)
      if (auto found = find_alone(i)) return found;
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::string name(std::size_t i) const { return words_.agent(AgentId(i)); }
  [[nodiscard]] std::optional<Error> find_polygon_in_space() const;
  [[nodiscard]] std::optional<Error> find_unsupported() const;
  [[nodiscard]] std::optional<Error> find_waiting() const;
  /// `place_of(agent)`: null if it need not be anywhere. `may_overlap(agent)`: with others that
  /// may.
  template <class PlaceOf, class MayOverlap>
  [[nodiscard]] std::optional<Error> find_overlap(const PlaceOf& place_of,
                                                  const MayOverlap& may_overlap,
                                                  const std::string& what) const;
  [[nodiscard]] std::optional<Error> find_obstacle() const;
  [[nodiscard]] std::optional<Error> find_alone(std::size_t i) const;

  const std::shared_ptr<const Roadmap>& roads_;
  const std::vector<Agent>& agents_;
  const Resolution& resolution_;
  const std::vector<MovingObstacle>& obstacles_;
  const Ticks now_;
  const Words& words_;
};

std::optional<Error> Finder::find_polygon_in_space() const {
  const auto is_high = [](const auto& stop) { return stop.at.z != 0; };
  const auto flies = [&](const MovingObstacle& obstacle) {
    return std::any_of(obstacle.path.begin(), obstacle.path.end(), is_high);
  };
  if (roads_->is_flat() && std::none_of(obstacles_.begin(), obstacles_.end(), flies))
    return std::nullopt;
  const auto refusal = [](const std::string& name) {
    return invalid(name + " is a polygon, but there are places with a height: in space bodies " +
                   "are spheres");
  };
  for (std::size_t i = 0; i < agents_.size(); ++i)
    for (const Body& body : bodies_of(agents_[i]))
      if (!std::holds_alternative<Disc>(body)) return refusal(name(i));
  for (std::size_t o = 0; o < obstacles_.size(); ++o)
    if (!std::holds_alternative<Disc>(obstacles_[o].body)) return refusal(words_.obstacle(o));
  return std::nullopt;
}

std::optional<Error> Finder::find_unsupported() const {
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    if (reach_of(agents_[i]) > geometry::kMaxLength) return out_of_range(name(i) + " is too large");
    for (const Edge& lane : roads_->edges())
      if (!travel_time(*roads_, lane, agents_[i].speed))
        return out_of_range("the lane from " + words_.vertex(lane.from) + " to " +
                            words_.vertex(lane.to) + " takes " + name(i) +
                            " less than half a step of " + words_.time(1) + ", or too long");
  }
  return std::nullopt;
}

std::optional<Error> Finder::find_waiting() const {
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    const Agent& agent = agents_[i];
    if (!roads_->may_wait(agent.start))
      return invalid(name(i) + " starts at " + words_.vertex(agent.start) +
                     ", where nobody may wait");
    for (const VertexId goal : agent.goals.vertices())
      if (!agent.leaves && !roads_->may_wait(goal))
        return invalid(name(i) + " would stay at " + words_.vertex(goal) +
                       ", where nobody may wait");
  }
  return std::nullopt;
}

template <class PlaceOf, class MayOverlap>
std::optional<Error> Finder::find_overlap(const PlaceOf& place_of, const MayOverlap& may_overlap,
                                          const std::string& what) const {
  geometry::BodyIndex strict, lenient;
  for (std::size_t j = 0; j < agents_.size(); ++j) {
    const VertexId* const w = place_of(agents_[j]);
    if (w == nullptr) continue;
    const Body& body = body_at(*roads_, agents_[j], *w);
    auto i = strict.first_overlap(body, roads_->place(*w));
    if (!i && !may_overlap(agents_[j])) i = lenient.first_overlap(body, roads_->place(*w));
    if (i)
      return no_plan("the " + what + " of " + name(*i) + " at " +
                     words_.vertex(*place_of(agents_[*i])) + " and " + name(j) + " at " +
                     words_.vertex(*w) + " overlap");
    (may_overlap(agents_[j]) ? lenient : strict).add(j, body, roads_->place(*w));
  }
  return std::nullopt;
}

std::optional<Error> Finder::find_obstacle() const {
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const MovingObstacle& obstacle = obstacles_[o];
    if (geometry::enclosing_radius(obstacle.body) > geometry::kMaxLength)
      return out_of_range(words_.obstacle(o) + " is too large");
    if (obstacle.path.empty()) continue;
    for (std::size_t i = 0; i < agents_.size(); ++i)
      if (is_in_the_way(obstacle, now_, body_at(*roads_, agents_[i], agents_[i].start),
                        roads_->place(agents_[i].start)))
        return no_plan(words_.obstacle(o) + " is at the start of " + name(i) + " at " +
                       words_.vertex(agents_[i].start));
  }
  return std::nullopt;
}

// What stands in the way of an agent that is alone.
std::optional<Error> Finder::find_alone(std::size_t i) const {
  const auto make = [&](const Agent& one) {
    return Instance::make(roads_, {one}, resolution_, {}, {}, now_);
  };
  const auto alone = make(agents_[i]);
  if (alone || alone.error().code != ErrorCode::no_plan) return std::nullopt;
  Agent patient = agents_[i];
  patient.deadline.reset();
  const auto late = make(patient);
  if (!late)
    return no_plan(
        name(i) + " cannot get from " + words_.vertex(agents_[i].start) + " to " +
        (agents_[i].goals.is_single() ? words_.vertex(agents_[i].goal()) : "any of its goals"));
  return no_plan(name(i) + " cannot arrive before " +
                 words_.time(now_ + free_cost(*late, AgentId(0)).value()) +
                 ", and its deadline is " + words_.time(*agents_[i].deadline));
}

}  // namespace

Error in_words(const Error& error, const std::shared_ptr<const Roadmap>& roadmap,
               const std::vector<Agent>& agents, const Resolution& resolution,
               const std::vector<MovingObstacle>& obstacles, Ticks now, const Words& words) {
  return Finder(roadmap, agents, resolution, obstacles, now, words).find().value_or(error);
}

}  // namespace quadrille::continuous
