// SPDX-License-Identifier: MIT
#include "quadrille/fleet/pose_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>

#include "conversions.hpp"

namespace quadrille::fleet {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
/// Headings that differ by less are one: far less than lanes can differ in that are not parallel,
/// and more than the errors of a double.
constexpr double kSameHeading = 1e-7;

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }
Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }

/// In [0, 2 pi).
double normalised(double heading) {
  const double rest = std::fmod(heading, kFullTurn);
  const double positive = rest < 0 ? rest + kFullTurn : rest;
  return positive > kFullTurn - kSameHeading / 2 ? 0 : positive;
}

/// The shorter way round, in [0, pi].
double angle_between(double a, double b) {
  const double difference = std::abs(a - b);
  return std::min(difference, kFullTurn - difference);
}

/// Of a lane; nullopt if it goes straight up or down.
std::optional<double> direction(const continuous::Roadmap& roads, const continuous::Edge& lane) {
  const auto &from = roads.position(lane.from), &to = roads.position(lane.to);
  if (from.x == to.x && from.y == to.y) return std::nullopt;
  return normalised(std::atan2(static_cast<double>((to.y - from.y).value()),
                               static_cast<double>((to.x - from.x).value())));
}

continuous::Groups intersection(const continuous::Groups& a, const continuous::Groups& b) {
  continuous::Groups both;
  for (std::size_t g = 0; g < continuous::kMaxGroups; ++g)
    if (a.contains(Group(g)) && b.contains(Group(g))) both.insert(Group(g));
  return both;
}

void add(continuous::Groups& groups, const continuous::Groups& more) {
  for (std::size_t g = 0; g < continuous::kMaxGroups; ++g)
    if (more.contains(Group(g))) groups.insert(Group(g));
}

/// At least one tick. nullopt if it would take too long.
std::optional<continuous::Ticks> turn_time(double angle, RadiansPerSecond rate,
                                           const continuous::Resolution& resolution) {
  const auto ticks = time_to_units(Radians(angle) / rate, true, resolution);
  if (!ticks) return std::nullopt;
  return std::max(*ticks, continuous::Ticks(1));
}

}  // namespace

VertexId PoseRoadmap::facing(VertexId place, Radians heading) const {
  QUADRILLE_REQUIRE(std::isfinite(heading.value()), "a heading");
  const double wanted = normalised(heading.value());
  const auto& poses = any_heading(place);
  return *std::min_element(poses.begin(), poses.end(), [&](VertexId a, VertexId b) {
    return angle_between(headings_[a].value(), wanted) <
           angle_between(headings_[b].value(), wanted);
  });
}

PoseBuilder& PoseBuilder::heading(VertexId place, Radians heading) {
  headings_.emplace_back(place, heading);
  return *this;
}

PoseBuilder& PoseBuilder::turn_rate(Group group, RadiansPerSecond rate) {
  groups_.push_back({group, {rate, kStraight}});
  return *this;
}

PoseBuilder& PoseBuilder::car(Radians max_steer) {
  others_ = {std::nullopt, max_steer};
  return *this;
}

PoseBuilder& PoseBuilder::car(Group group, Radians max_steer) {
  groups_.push_back({group, {std::nullopt, max_steer}});
  return *this;
}

/// The poses of all places, the lanes between them, and the turns.
class PoseBuilder::Poses {
 public:
  Poses(const continuous::Roadmap& roads, const continuous::Resolution& resolution,
        std::vector<Members> kinds)
      : roads_(roads), resolution_(resolution), kinds_(std::move(kinds)) {
    at_.resize(roads.num_vertices());
  }

  void add_heading(VertexId place, double heading) { at_[place].push_back(normalised(heading)); }

  /// When all headings are known.
  void number() {
    first_.resize(at_.size());
    std::size_t count = 0;
    for (const VertexId place : IdRange<VertexId>(at_.size())) {
      std::vector<double>& headings = at_[place];
      if (headings.empty()) headings.push_back(0);
      std::sort(headings.begin(), headings.end());
      const auto is_same = [](double a, double b) { return b - a < kSameHeading; };
      headings.erase(std::unique(headings.begin(), headings.end(), is_same), headings.end());
      first_[place] = count;
      count += headings.size();
    }
  }

  [[nodiscard]] const std::vector<double>& headings(VertexId place) const { return at_[place]; }
  [[nodiscard]] VertexId pose(VertexId place, std::size_t heading) const {
    return VertexId(first_[place] + heading);
  }

  /// What a robot has that faces so, or turns from one heading to another.
  continuous::ShapeId shape(double from, double to) {
    const geometry::Direction a = geometry::Direction::at(from), b = geometry::Direction::at(to);
    const auto [known, is_new] =
        shapes_.try_emplace(std::tuple(a.x, a.y, b.x, b.y), continuous::ShapeId(turns_.size()));
    if (is_new) turns_.push_back({a, b});
    return known->second;
  }
  [[nodiscard]] const std::vector<Roadmap::Turn>& turns() const noexcept { return turns_; }

  void add_turns(VertexId place, std::vector<continuous::Edge>& edges) {
    const std::vector<double>& headings = at_[place];
    for (std::size_t a = 0; a < headings.size(); ++a)
      for (std::size_t b = 0; b < headings.size(); ++b) {
        if (a == b) continue;
        std::map<continuous::Ticks, continuous::Groups> by_duration;
        for (const Members& members : kinds_)
          if (members.kind.rate)
            add(by_duration[turn_time(angle_between(headings[a], headings[b]), *members.kind.rate,
                                      resolution_)
                                .value()],
                members.groups);
        for (const auto& [duration, groups] : by_duration)
          edges.push_back(
              {pose(place, a), pose(place, b), duration, groups, shape(headings[a], headings[b])});
      }
  }

  /// `direction`: a heading of both ends.
  void add_lane(const continuous::Edge& lane, double direction,
                std::vector<continuous::Edge>& edges) {
    const std::size_t end = index_of(lane.to, direction);
    const VertexId to = pose(lane.to, end);
    const double faced = at_[lane.to][end];
    const std::vector<double>& headings = at_[lane.from];
    for (std::size_t a = 0; a < headings.size(); ++a) {
      continuous::Groups groups;
      for (const Members& members : kinds_)
        if (angle_between(headings[a], direction) <= members.kind.steer.value() + kSameHeading)
          add(groups, intersection(members.groups, lane.open_to));
      if (!groups.is_empty())
        edges.push_back({pose(lane.from, a), to, lane.duration, groups, shape(headings[a], faced),
                         lane.speed_limit});
    }
  }

 private:
  [[nodiscard]] std::size_t index_of(VertexId place, double heading) const {
    const std::vector<double>& headings = at_[place];
    const auto found = std::min_element(headings.begin(), headings.end(), [&](double a, double b) {
      return angle_between(a, heading) < angle_between(b, heading);
    });
    return static_cast<std::size_t>(found - headings.begin());
  }

  const continuous::Roadmap& roads_;
  const continuous::Resolution resolution_;
  const std::vector<Members> kinds_;
  IdVector<VertexId, std::vector<double>> at_;  // by place, increasing
  IdVector<VertexId, std::size_t> first_;       // its first pose
  using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;
  std::map<Key, continuous::ShapeId> shapes_;
  std::vector<Roadmap::Turn> turns_;  // by shape
};

std::optional<Error> PoseBuilder::check() const {
  const continuous::Resolution resolution = places_.unit_sizes();
  std::vector<Kind> kinds{others_};
  for (const auto& [group, kind] : groups_) {
    if (group.index() < 1 || group.index() > places_.num_groups())
      return invalid("a kind of robots is a group that the roadmap does not have");
    kinds.push_back(kind);
  }
  for (const Kind& kind : kinds) {
    if (!(kind.steer >= Radians(0) && kind.steer <= Radians(std::numbers::pi)))
      return out_of_range("a car steers by " + to_string(kind.steer) +
                          ", which is not from 0 to 180 deg");
    if (!kind.rate) continue;
    const bool is_rate = kind.rate->value() > 0 && std::isfinite(kind.rate->value());
    if (!is_rate || !turn_time(std::numbers::pi, *kind.rate, resolution))
      return out_of_range("robots turn by " + to_string(*kind.rate) + ", which is not supported");
  }
  for (const auto& [place, heading] : headings_) {
    if (place.index() >= places_.num_vertices())
      return invalid("there is a heading at a place that the roadmap does not have");
    if (!std::isfinite(heading.value()))
      return out_of_range("a heading at " + places_.name(place) + " is no finite angle");
  }
  return std::nullopt;
}

/// All groups, each once. What was said last counts.
std::vector<PoseBuilder::Members> PoseBuilder::kinds() const {
  std::vector<Members> kinds{{others_, {}}};
  for (std::size_t g = 0; g < continuous::kMaxGroups; ++g) {
    const auto own = std::find_if(groups_.rbegin(), groups_.rend(),
                                  [&](const auto& group) { return group.first == Group(g); });
    if (own == groups_.rend())
      kinds.front().groups.insert(Group(g));
    else
      kinds.push_back({own->second, {Group(g)}});
  }
  return kinds;
}

Result<PoseRoadmap> PoseBuilder::build() const {
  if (auto error = check()) return *error;
  const continuous::Roadmap& roads = *places_.in_units();
  Poses poses(roads, places_.unit_sizes(), kinds());
  for (const continuous::Edge& lane : roads.edges()) {
    const auto heading = direction(roads, lane);
    if (!heading)
      return invalid("the lane from " + places_.name(lane.from) + " to " + places_.name(lane.to) +
                     " goes straight up or down, and has no heading");
    poses.add_heading(lane.from, *heading);
    poses.add_heading(lane.to, *heading);
  }
  for (const auto& [place, heading] : headings_) poses.add_heading(place, heading.value());
  poses.number();
  static_cast<void>(poses.shape(0, 0));  // the body as it is given

  PoseRoadmap result(places_);
  std::vector<continuous::Point> points;
  std::vector<continuous::Edge> edges;
  std::vector<continuous::ShapeId> shapes;
  std::vector<VertexId> no_waiting;
  std::vector<std::string> names;
  std::map<std::string, VertexId, std::less<>> by_name;
  for (const VertexId place : places_.vertex_ids()) {
    const bool is_named = !(*places_.names_)[place.index()].empty();
    result.poses_.push_back({});
    for (const double heading : poses.headings(place)) {
      const VertexId pose(points.size());
      result.poses_[place].push_back(pose);
      result.places_.push_back(place);
      result.headings_.push_back(Radians(heading));
      points.push_back(roads.position(place));
      if (!roads.may_wait(place)) no_waiting.push_back(pose);
      shapes.push_back(poses.shape(heading, heading));
      names.push_back(places_.name(place) + " facing " + to_string(Radians(heading)));
      if (is_named) by_name.emplace(names.back(), pose);
    }
    poses.add_turns(place, edges);
  }
  for (const continuous::Edge& lane : roads.edges())
    poses.add_lane(lane, direction(roads, lane).value(), edges);
  auto made = continuous::Roadmap::make(std::move(points), std::move(edges), {}, std::move(shapes),
                                        std::move(no_waiting));
  if (!made) return made.error();
  Roadmap& roadmap = result.roadmap_;
  roadmap.roads_ = std::make_shared<const continuous::Roadmap>(std::move(made).value());
  roadmap.turns_ = std::make_shared<const std::vector<Roadmap::Turn>>(poses.turns());
  roadmap.names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
  roadmap.by_name_ =
      std::make_shared<const std::map<std::string, VertexId, std::less<>>>(std::move(by_name));
  return result;
}

}  // namespace quadrille::fleet
