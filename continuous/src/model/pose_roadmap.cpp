// SPDX-License-Identifier: MIT
#include "quadrille/continuous/pose_roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

namespace quadrille::continuous {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kFullTurn = 2 * std::numbers::pi;
/// Headings that differ by less are one: far less than lanes can differ in that are not parallel,
/// and more than the errors of a double.
constexpr double kSameHeading = 1e-7;

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }
Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }
std::string number(VertexId v) { return std::to_string(v.index()); }

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
bool is_same(double a, double b) { return angle_between(a, b) < kSameHeading; }

/// Of a lane; nullopt if it goes straight up or down.
std::optional<double> direction(const Roadmap& roads, const Edge& lane) {
  const Point &from = roads.position(lane.from), &to = roads.position(lane.to);
  if (from.x == to.x && from.y == to.y) return std::nullopt;
  return normalised(std::atan2(static_cast<double>((to.y - from.y).value()),
                               static_cast<double>((to.x - from.x).value())));
}

Groups intersection(const Groups& a, const Groups& b) {
  Groups both;
  for (std::size_t g = 0; g < kMaxGroups; ++g)
    if (a.contains(GroupId(g)) && b.contains(GroupId(g))) both.insert(GroupId(g));
  return both;
}

void add(Groups& groups, const Groups& more) {
  for (std::size_t g = 0; g < kMaxGroups; ++g)
    if (more.contains(GroupId(g))) groups.insert(GroupId(g));
}

/// Up to whole ticks, at least one; a number that differs from a whole one by a billionth is meant
/// to be that. nullopt if it would take too long.
std::optional<Ticks> turn_time(double angle, double rate) {
  const double ticks = angle / rate;
  if (!(ticks <= static_cast<double>(geometry::kMaxDuration.value()))) return std::nullopt;
  const double nearest = std::round(ticks);
  const double whole = std::abs(ticks - nearest) <= 1e-9 * ticks ? nearest : std::ceil(ticks);
  return std::max(Ticks(static_cast<std::int64_t>(whole)), Ticks(1));
}

std::optional<Error> why_not(std::span<const Turning> kinds) {
  for (const Turning& kind : kinds) {
    if (!(kind.steer >= 0 && kind.steer <= kHalfTurn))
      return out_of_range("a steering is not from 0 to half a turn");
    if (kind.rate &&
        !(*kind.rate > 0 && std::isfinite(*kind.rate) && turn_time(kHalfTurn, *kind.rate)))
      return out_of_range("a rate of turns is not supported");
  }
  return std::nullopt;
}

std::optional<Error> why_not(const Roadmap& places, const HeadingRules& rules) {
  const auto exists = [&](VertexId v) { return v.index() < places.num_vertices(); };
  for (const auto* list : {&rules.further, &rules.stands})
    for (const HeadingRules::Heading& told : *list) {
      if (!exists(told.place))
        return invalid("there is a heading at a place that the roadmap does not have");
      if (!std::isfinite(told.heading))
        return out_of_range("a heading at vertex " + number(told.place) + " is no finite angle");
    }
  for (const HeadingRules::Lane& told : rules.lanes) {
    const bool is_lane = exists(told.from) && exists(told.to) &&
                         std::ranges::any_of(places.out_edges(told.from),
                                             [&](EdgeId e) { return places.to(e) == told.to; });
    if (!is_lane) return invalid("there is a heading on a lane that the roadmap does not have");
    if (!std::isfinite(told.heading))
      return out_of_range("a heading from vertex " + number(told.from) + " to vertex " +
                          number(told.to) + " is no finite angle");
  }
  for (const HeadingRules::Turns& told : rules.turns) {
    if (!exists(told.place))
      return invalid("there are turns at a place that the roadmap does not have");
    if (!(told.most > 0 && turn_time(kHalfTurn, told.most)))
      return out_of_range("a rate of turns at vertex " + number(told.place) + " is not supported");
  }
  if (!places.lane_places().empty())
    return invalid("a roadmap with vertices in the middle of moves has no headings");
  return std::nullopt;
}

}  // namespace

/// The poses of all places, the lanes between them, and the turns.
class PoseRoadmap::Making {
 public:
  Making(const Roadmap& roads, std::span<const Turning> kinds, const HeadingRules& rules)
      : roads_(roads), kinds_(kinds.begin(), kinds.end()) {
    headings_.resize(roads.num_vertices());
    at_.resize(roads.num_vertices());
    stand_.resize(roads.num_vertices());
    turns_at_.resize(roads.num_vertices());
    for (const HeadingRules::Lane& told : rules.lanes) {
      std::vector<double>& lane = lanes_[{told.from, told.to}];
      const double heading = normalised(told.heading);
      if (std::ranges::none_of(lane, [&](double other) { return is_same(other, heading); }))
        lane.push_back(heading);
    }
    for (const HeadingRules::Turns& told : rules.turns) {
      HeadingRules::Turns& all = turns_at_[told.place];
      all.counter_clockwise = all.counter_clockwise && told.counter_clockwise;
      all.clockwise = all.clockwise && told.clockwise;
      all.most = std::min(all.most, told.most);
    }
  }

  std::optional<Error> add_headings(const HeadingRules& rules) {
    for (const auto& [place, heading] : rules.stands) {
      if (stand_[place] && !is_same(*stand_[place], normalised(heading)))
        return invalid("vertex " + number(place) + " is told twice how robots stand there");
      stand_[place] = normalised(heading);
      headings_[place].push_back(normalised(heading));
    }
    for (const Edge& lane : roads_.edges()) {
      if (!direction(roads_, lane))
        return invalid("the lane from vertex " + number(lane.from) + " to vertex " +
                       number(lane.to) + " goes straight up or down, and has no heading");
      for (const double heading : faced(lane)) {
        headings_[lane.from].push_back(heading);
        headings_[lane.to].push_back(heading);
      }
    }
    for (const auto& [place, heading] : rules.further)
      headings_[place].push_back(normalised(heading));
    for (const VertexId place : IdRange<VertexId>(at_.size())) add_poses(place);
    return std::nullopt;
  }

  Result<PoseRoadmap> run() {
    static_cast<void>(shape(0, 0));  // the body as it is given
    PoseRoadmap result;
    for (const VertexId place : IdRange<VertexId>(at_.size())) {
      result.poses_.push_back({});
      result.stays_.push_back({});
      for (const auto& [heading, role] : at_[place]) {
        const VertexId pose(points_.size());
        if (role != Role::leaving) result.poses_[place].push_back(pose);
        if (role == Role::all) result.stays_[place].push_back(pose);
        result.places_.push_back(place);
        result.headings_.push_back(heading);
        points_.push_back(roads_.position(place));
        if (!roads_.may_wait(place)) no_waiting_.push_back(pose);
        shapes_.push_back(shape(heading, heading));
      }
      add_turns(place);
    }
    for (const Edge& lane : roads_.edges())
      for (const double heading : faced(lane)) add_lane(lane, heading);
    auto made = Roadmap::make(std::move(points_), std::move(edges_), {}, std::move(shapes_),
                              std::move(no_waiting_));
    if (!made) return made.error();
    result.roadmap_ = std::make_shared<const Roadmap>(std::move(made).value());
    result.turns_ = std::make_shared<const std::vector<HeadingTurn>>(std::move(turns_));
    return result;
  }

 private:
  /// Where robots stand in one heading, the others are of those who arrive or who leave.
  enum class Role { all, arriving, leaving };
  struct Pose {
    double heading;
    Role role;
  };

  /// When all headings of the place are known.
  void add_poses(VertexId place) {
    std::vector<double>& headings = headings_[place];
    if (headings.empty()) headings.push_back(0);
    const HeadingRules::Turns& turns = turns_at_[place];
    // Whoever turns one way only gets everywhere by turns of less than half a turn.
    if (turns.clockwise != turns.counter_clockwise)
      for (std::size_t k = 0, n = headings.size(); k < n; ++k)
        for (const int quarters : {1, 2, 3})
          headings.push_back(normalised(headings[k] + quarters * kHalfTurn / 2));
    std::sort(headings.begin(), headings.end());
    const auto is_near = [](double a, double b) { return b - a < kSameHeading; };
    headings.erase(std::unique(headings.begin(), headings.end(), is_near), headings.end());
    first_.push_back(num_poses_);
    for (const double heading : headings) {
      const bool is_common = !stand_[place] || is_same(heading, *stand_[place]);
      if (is_common)
        at_[place].push_back({heading, Role::all});
      else
        for (const Role role : {Role::arriving, Role::leaving})
          at_[place].push_back({heading, role});
    }
    num_poses_ += at_[place].size();
  }

  [[nodiscard]] VertexId pose(VertexId place, std::size_t number) const {
    return VertexId(first_[place] + number);
  }

  /// How robots face that go along a lane.
  [[nodiscard]] std::vector<double> faced(const Edge& lane) const {
    const auto told = lanes_.find({lane.from, lane.to});
    if (told != lanes_.end()) return told->second;
    return {direction(roads_, lane).value()};
  }

  ShapeId shape(double from, double to) {
    const auto a = geometry::Direction::at(from), b = geometry::Direction::at(to);
    const auto [known, is_new] =
        shape_of_.try_emplace(std::tuple(a.x, a.y, b.x, b.y), ShapeId(turns_.size()));
    if (is_new) turns_.push_back({a, b});
    return known->second;
  }

  /// From whoever arrives to how robots stand, and from there to whoever leaves; by several steps
  /// where they turn one way only.
  [[nodiscard]] static bool may_follow(const HeadingRules::Turns& turns, Role a, Role b) {
    if (a == b) return a == Role::all || turns.clockwise != turns.counter_clockwise;
    return (a == Role::arriving && b == Role::all) || (a == Role::all && b == Role::leaving);
  }
  /// By the shorter way round; half a turn goes counter-clockwise.
  [[nodiscard]] static bool may_turn(const HeadingRules::Turns& turns, double a, double b) {
    if (turns.clockwise && turns.counter_clockwise) return true;
    const bool goes_left = normalised(b - a) <= kHalfTurn + kSameHeading;
    const bool is_half = is_same(angle_between(a, b), kHalfTurn);
    return goes_left || is_half ? turns.counter_clockwise : turns.clockwise;
  }

  void add_turns(VertexId place) {
    const std::vector<Pose>& poses = at_[place];
    const HeadingRules::Turns& turns = turns_at_[place];
    for (std::size_t a = 0; a < poses.size(); ++a)
      for (std::size_t b = 0; b < poses.size(); ++b) {
        const double from = poses[a].heading, to = poses[b].heading;
        if (a == b || !may_follow(turns, poses[a].role, poses[b].role) ||
            !may_turn(turns, from, to))
          continue;
        std::map<Ticks, Groups> by_duration;
        for (const Turning& kind : kinds_)
          if (kind.rate)
            add(by_duration[turn_time(angle_between(from, to), std::min(*kind.rate, turns.most))
                                .value()],
                kind.groups);
        for (const auto& [duration, groups] : by_duration)
          if (!groups.is_empty())
            edges_.push_back({pose(place, a), pose(place, b), duration, groups, shape(from, to)});
      }
  }

  /// `direction`: a heading of both ends.
  void add_lane(const Edge& lane, double direction) {
    const std::size_t end = index_of(lane.to, direction);
    const std::vector<Pose>& poses = at_[lane.from];
    for (std::size_t a = 0; a < poses.size(); ++a) {
      if (poses[a].role == Role::arriving) continue;
      Groups groups;
      for (const Turning& kind : kinds_)
        if (angle_between(poses[a].heading, direction) <= kind.steer + kSameHeading)
          add(groups, intersection(kind.groups, lane.open_to));
      if (!groups.is_empty())
        edges_.push_back({pose(lane.from, a), pose(lane.to, end), lane.duration, groups,
                          shape(poses[a].heading, at_[lane.to][end].heading), lane.speed_limit});
    }
  }

  /// Of those in which robots arrive.
  [[nodiscard]] std::size_t index_of(VertexId place, double heading) const {
    const std::vector<Pose>& poses = at_[place];
    const auto away = [&](const Pose& p) {
      return p.role == Role::leaving ? kFullTurn : angle_between(p.heading, heading);
    };
    const auto found = std::ranges::min_element(poses, {}, away);
    return static_cast<std::size_t>(found - poses.begin());
  }

  const Roadmap& roads_;
  const std::vector<Turning> kinds_;
  std::map<std::pair<VertexId, VertexId>, std::vector<double>> lanes_;
  IdVector<VertexId, std::vector<double>> headings_;  // by place, increasing in the end
  IdVector<VertexId, std::optional<double>> stand_;   // by place
  IdVector<VertexId, HeadingRules::Turns> turns_at_;  // by place
  IdVector<VertexId, std::vector<Pose>> at_;          // by place
  IdVector<VertexId, std::size_t> first_;             // its first pose
  std::size_t num_poses_ = 0;
  std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>, ShapeId> shape_of_;
  std::vector<HeadingTurn> turns_;  // by shape
  std::vector<Point> points_;
  std::vector<Edge> edges_;
  std::vector<ShapeId> shapes_;
  std::vector<VertexId> no_waiting_;
};

Result<PoseRoadmap> PoseRoadmap::make(const Roadmap& places, std::span<const Turning> kinds,
                                      const HeadingRules& rules) {
  if (auto error = why_not(kinds)) return *error;
  if (auto error = why_not(places, rules)) return *error;
  Making making(places, kinds, rules);
  if (auto error = making.add_headings(rules)) return *error;
  return making.run();
}

VertexId PoseRoadmap::facing(VertexId place, double heading) const {
  QUADRILLE_REQUIRE(std::isfinite(heading), "a heading");
  QUADRILLE_REQUIRE(place.index() < poses_.size(), "a place");
  const auto& poses = poses_[place];
  const double wanted = normalised(heading);
  return *std::ranges::min_element(
      poses, {}, [&](VertexId pose) { return angle_between(headings_[pose], wanted); });
}

bool PoseRoadmap::is_leaving(VertexId pose) const {
  const auto& others = poses_[place(pose)];
  return std::ranges::find(others, pose) == others.end();
}

Result<std::vector<Body>> shapes_of(const Body& body, const std::vector<HeadingTurn>& turns) {
  std::vector<Body> shapes;
  if (std::holds_alternative<Disc>(body)) return shapes;
  for (auto turn = turns.begin() + 1; turn != turns.end(); ++turn) {
    auto shape = turn->from == turn->to ? geometry::turned(body, turn->from)
                                        : geometry::swept_by_turn(body, turn->from, turn->to);
    if (!shape) return Error{shape.error().code, "is too large to turn", {}};
    shapes.push_back(std::move(shape).value());
  }
  return shapes;
}

}  // namespace quadrille::continuous
