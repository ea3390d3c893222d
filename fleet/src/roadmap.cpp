// SPDX-License-Identifier: MIT
#include "quadrille/fleet/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "conversions.hpp"
#include "quadrille/continuous/quantise.hpp"

namespace quadrille::fleet {
namespace {

std::string text(const Point& place) {
  return "(" + to_string(place.x) + ", " + to_string(place.y) +
         (place.z == Metres(0) ? ")" : ", " + to_string(place.z) + ")");
}

Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }

/// The same, alike for all who say the same.
LaneSpec in_order(LaneSpec spec) {
  std::sort(spec.only.begin(), spec.only.end());
  spec.only.erase(std::unique(spec.only.begin(), spec.only.end()), spec.only.end());
  std::stable_sort(
      spec.kinds.begin(), spec.kinds.end(),
      [](const LaneSpec::Kind& a, const LaneSpec::Kind& b) { return a.group < b.group; });
  return spec;
}

}  // namespace

Metres distance(const Point& a, const Point& b) {
  const double x = (a.x - b.x).value(), y = (a.y - b.y).value(), z = (a.z - b.z).value();
  return Metres(z == 0 ? std::hypot(x, y) : std::hypot(x, y, z));
}

Point Roadmap::position(VertexId v) const { return in_metres(roads_->position(v), unit_sizes()); }

std::string Roadmap::name(VertexId v) const {
  QUADRILLE_REQUIRE(v.index() < num_vertices(), "a vertex of this roadmap");
  const std::string& name = (*names_)[v.index()];
  return name.empty() ? text(position(v)) : name;
}

std::optional<VertexId> Roadmap::find(std::string_view name) const {
  const auto found = by_name_->find(name);
  if (found == by_name_->end()) return std::nullopt;
  return found->second;
}

VertexId Roadmap::nearest(const Point& place) const {
  QUADRILLE_REQUIRE(num_vertices() > 0, "a roadmap with vertices");
  VertexId best(0);
  Metres least = distance(position(best), place);
  for (const VertexId v : vertex_ids()) {
    const Metres here = distance(position(v), place);
    if (!(here < least)) continue;
    best = v;
    least = here;
  }
  return best;
}

VertexId RoadmapBuilder::vertex(const Point& place, std::string name) {
  places_.push_back(place);
  names_.push_back(std::move(name));
  return VertexId(places_.size() - 1);
}

RoadmapBuilder& RoadmapBuilder::road(VertexId a, VertexId b, LaneSpec spec) {
  return lane(a, b, spec).lane(b, a, std::move(spec));
}

RoadmapBuilder& RoadmapBuilder::lane(VertexId from, VertexId to, LaneSpec spec) {
  lanes_.push_back({from, to, std::move(spec)});
  return *this;
}

RoadmapBuilder& RoadmapBuilder::no_waiting(VertexId v) {
  no_waiting_.push_back(v);
  return *this;
}

RoadmapBuilder& RoadmapBuilder::close(VertexId a, VertexId b) {
  std::erase_if(lanes_, [&](const Lane& lane) {
    return (lane.from == a && lane.to == b) || (lane.from == b && lane.to == a);
  });
  return *this;
}

std::string RoadmapBuilder::name_of(VertexId v) const {
  if (v.index() >= places_.size()) return "vertex " + std::to_string(v.index());
  const std::string& name = names_[v.index()];
  return name.empty() ? text(places_[v.index()]) : "'" + name + "'";
}

Result<std::vector<continuous::Point>> RoadmapBuilder::rounded_places() const {
  const continuous::Resolution sizes(resolution_.length.value(), resolution_.time.value());
  if (!sizes.is_valid())
    return Error{ErrorCode::out_of_range,
                 "the resolution is " + to_string(resolution_.length) + " and " +
                     to_string(resolution_.time) + "; both have to be positive and finite",
                 {}};
  std::vector<continuous::Point> points;
  points.reserve(places_.size());
  for (std::size_t v = 0; v < places_.size(); ++v) {
    const auto point = to_units(places_[v], sizes);
    if (!point)
      return Error{ErrorCode::out_of_range,
                   "vertex " + name_of(VertexId(v)) + " at " + text(places_[v]) +
                       " is too far away for a resolution of " + to_string(resolution_.length),
                   {}};
    points.push_back(*point);
  }
  return points;
}

Result<continuous::Groups> RoadmapBuilder::groups(const LaneSpec& spec,
                                                  const std::string& what) const {
  continuous::Groups open_to = spec.only.empty() ? continuous::Groups::all() : continuous::Groups{};
  for (const Group group : spec.only) {
    if (!is_made(group))
      return invalid(what + ": it is for a group that this builder has not made");
    open_to.insert(group);
  }
  return open_to;
}

std::optional<Error> RoadmapBuilder::set_pace(continuous::Edge& edge,
                                              std::optional<MetresPerSecond> speed_limit,
                                              std::optional<Seconds> duration,
                                              const std::string& what) const {
  const continuous::Resolution sizes(resolution_.length.value(), resolution_.time.value());
  const auto unsupported = [&](const std::string& given) {
    return Error{ErrorCode::out_of_range,
                 what + ": " + given + " is not supported at a resolution of " +
                     to_string(resolution_.length) + " and " + to_string(resolution_.time),
                 {}};
  };
  if (speed_limit && duration) return invalid(what + ": it has a duration and a speed limit");
  if (speed_limit) {
    edge.speed_limit = continuous::quantise_speed(speed_limit->value(), sizes);
    if (!edge.speed_limit) return unsupported("a speed limit of " + to_string(*speed_limit));
  }
  if (duration) {
    edge.duration = *duration > Seconds(0) ? time_to_units(*duration, true, sizes) : std::nullopt;
    if (!edge.duration) return unsupported("a duration of " + to_string(*duration));
  }
  return std::nullopt;
}

std::optional<Error> RoadmapBuilder::add_edges(const Lane& lane, const std::string& what,
                                               std::vector<continuous::Edge>& edges) const {
  const auto open_to = groups(lane.spec, what);
  if (!open_to) return open_to.error();
  continuous::Groups others, told;
  for (const LaneSpec::Kind& kind : lane.spec.kinds) {
    if (!is_made(kind.group) || !open_to->contains(kind.group) || told.contains(kind.group))
      return invalid(what + ": it has a limit or a duration for a group that may not use it, or " +
                     "two for one group");
    told.insert(kind.group);
  }
  for (std::size_t g = 0; g < continuous::kMaxGroups; ++g)
    if (open_to->contains(Group(g)) && !told.contains(Group(g))) others.insert(Group(g));
  if (!others.is_empty()) {
    continuous::Edge edge{lane.from, lane.to, std::nullopt, others};
    if (auto error = set_pace(edge, lane.spec.speed_limit, lane.spec.duration, what)) return error;
    edges.push_back(edge);
  }
  for (const LaneSpec::Kind& kind : lane.spec.kinds) {
    continuous::Edge edge{lane.from, lane.to, std::nullopt, {kind.group}};
    if (auto error = set_pace(edge, kind.speed_limit, kind.duration, what)) return error;
    edges.push_back(edge);
  }
  return std::nullopt;
}

Result<std::vector<continuous::Edge>> RoadmapBuilder::edges(
    const std::vector<continuous::Point>& points) const {
  std::vector<continuous::Edge> edges;
  std::map<std::pair<VertexId, VertexId>, LaneSpec> known;
  for (const Lane& lane : lanes_) {
    const VertexId from = lane.from, to = lane.to;
    const std::string what = "a lane from " + name_of(from) + " to " + name_of(to);
    for (const VertexId end : {from, to})
      if (end.index() >= places_.size())
        return invalid(what + ": there are only " + std::to_string(places_.size()) + " vertices");
    if (points[from.index()] == points[to.index()])
      return invalid(what + ": both are in the same place" +
                     (from == to ? "" : " at a resolution of " + to_string(resolution_.length)));
    const auto [at, is_new] = known.try_emplace({from, to}, in_order(lane.spec));
    if (is_new) {
      if (auto error = add_edges(lane, what, edges)) return *error;
    } else if (const LaneSpec again = in_order(lane.spec); at->second != again) {
      return invalid(what + ": it is given twice, " +
                     (at->second.only != again.only ? "to different groups" : "in different ways"));
    }
  }
  return edges;
}

Result<Roadmap> RoadmapBuilder::build() const {
  if (num_groups_ >= continuous::kMaxGroups)
    return Error{ErrorCode::out_of_range,
                 "there are " + std::to_string(num_groups_) + " groups, not at most " +
                     std::to_string(continuous::kMaxGroups - 1),
                 {}};
  auto points = rounded_places();
  if (!points) return points.error();
  std::map<std::string, VertexId, std::less<>> by_name;
  for (std::size_t v = 0; v < names_.size(); ++v)
    if (!names_[v].empty() && !by_name.emplace(names_[v], VertexId(v)).second)
      return invalid("two vertices are called '" + names_[v] + "'");

  auto edges = this->edges(*points);
  if (!edges) return edges.error();
  std::vector<VertexId> passed = no_waiting_;
  std::sort(passed.begin(), passed.end());
  for (std::size_t k = 0; k < passed.size(); ++k) {
    const std::string who = "nobody may wait at " + name_of(passed[k]);
    if (passed[k].index() >= places_.size())
      return invalid(who + ": there are only " + std::to_string(places_.size()) + " vertices");
    if (k > 0 && passed[k - 1] == passed[k]) return invalid(who + ": that is told twice");
  }
  auto roads = continuous::Roadmap::make(std::move(points).value(), std::move(edges).value(), {},
                                         {}, std::move(passed));
  if (!roads) return roads.error();
  Roadmap roadmap;
  roadmap.resolution_ = resolution_;
  roadmap.num_groups_ = num_groups_;
  roadmap.roads_ = std::make_shared<const continuous::Roadmap>(std::move(roads).value());
  roadmap.names_ = std::make_shared<const std::vector<std::string>>(names_);
  roadmap.by_name_ =
      std::make_shared<const std::map<std::string, VertexId, std::less<>>>(std::move(by_name));
  return roadmap;
}

}  // namespace quadrille::fleet
