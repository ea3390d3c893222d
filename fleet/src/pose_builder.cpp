// SPDX-License-Identifier: MIT
#include "quadrille/fleet/pose_builder.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "conversions.hpp"

namespace quadrille::fleet {
namespace {

Error out_of_range(const std::string& message) { return {ErrorCode::out_of_range, message, {}}; }
Error invalid(const std::string& message) { return {ErrorCode::invalid_instance, message, {}}; }

}  // namespace

PoseBuilder& PoseBuilder::heading(VertexId place, Radians heading) {
  rules_.further.push_back({place, heading.value()});
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

PoseBuilder& PoseBuilder::lane_heading(VertexId from, VertexId to, Radians heading) {
  rules_.lanes.push_back({from, to, heading.value()});
  return *this;
}

PoseBuilder& PoseBuilder::stand(VertexId place, Radians heading) {
  rules_.stands.push_back({place, heading.value()});
  return *this;
}

PoseBuilder& PoseBuilder::turns(VertexId place, Turns allowed,
                                std::optional<RadiansPerSecond> most) {
  continuous::HeadingRules::Turns told{place};
  told.counter_clockwise = allowed == Turns::counter_clockwise || allowed == Turns::both;
  told.clockwise = allowed == Turns::clockwise || allowed == Turns::both;
  if (most) told.most = per_tick(*most);
  rules_.turns.push_back(told);
  return *this;
}

PoseBuilder& PoseBuilder::rules(const continuous::HeadingRules& rules) {
  const auto append = [](auto& list, const auto& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  append(rules_.further, rules.further);
  append(rules_.lanes, rules.lanes);
  append(rules_.stands, rules.stands);
  append(rules_.turns, rules.turns);
  return *this;
}

double PoseBuilder::per_tick(RadiansPerSecond rate) const {
  return rate.value() * places_.unit_sizes().time;
}

std::optional<Error> PoseBuilder::check() const {
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
    if (!is_rate ||
        !time_to_units(Radians(std::numbers::pi) / *kind.rate, true, places_.unit_sizes()))
      return out_of_range("robots turn by " + to_string(*kind.rate) + ", which is not supported");
  }
  for (const continuous::Edge& lane : places_.in_units()->edges()) {
    const Point from = places_.position(lane.from), to = places_.position(lane.to);
    if (from.x == to.x && from.y == to.y)
      return invalid("the lane from " + places_.name(lane.from) + " to " + places_.name(lane.to) +
                     " goes straight up or down, and has no heading");
  }
  return check_rules();
}

// What has to be said with names; the rest is said where poses are made.
std::optional<Error> PoseBuilder::check_rules() const {
  const auto exists = [&](VertexId v) { return v.index() < places_.num_vertices(); };
  for (const auto* list : {&rules_.further, &rules_.stands})
    for (const auto& [place, heading] : *list)
      if (exists(place) && !std::isfinite(heading))
        return out_of_range("a heading at " + places_.name(place) + " is no finite angle");
  for (const auto& [from, to, heading] : rules_.lanes)
    if (exists(from) && exists(to) && !std::isfinite(heading))
      return out_of_range("a heading from " + places_.name(from) + " to " + places_.name(to) +
                          " is no finite angle");
  std::map<VertexId, double> stands;
  for (const auto& [place, heading] : rules_.stands)
    if (const auto [known, is_new] = stands.emplace(place, heading);
        exists(place) && !is_new && known->second != heading)
      return invalid("robots stand in two headings at " + places_.name(place) + ": " +
                     to_string(Radians(known->second)) + " and " + to_string(Radians(heading)));
  for (const auto& told : rules_.turns)
    if (exists(told.place) && !(told.most > 0))
      return out_of_range("the turns at " + places_.name(told.place) + " are not supported");
  return std::nullopt;
}

/// All groups, each once. What was said last counts.
std::vector<continuous::Turning> PoseBuilder::kinds() const {
  const auto kind_of = [&](const Kind& kind) {
    continuous::Turning made;
    if (kind.rate) made.rate = per_tick(*kind.rate);
    made.steer = kind.steer.value();
    return made;
  };
  std::vector<continuous::Turning> kinds{kind_of(others_)};
  for (std::size_t g = 0; g < continuous::kMaxGroups; ++g) {
    const auto own = std::find_if(groups_.rbegin(), groups_.rend(),
                                  [&](const auto& group) { return group.first == Group(g); });
    if (own == groups_.rend()) {
      kinds.front().groups.insert(Group(g));
    } else {
      kinds.push_back(kind_of(own->second));
      kinds.back().groups = {Group(g)};
    }
  }
  return kinds;
}

Result<PoseRoadmap> PoseBuilder::build() const {
  if (auto error = check()) return *error;
  auto made = continuous::PoseRoadmap::make(*places_.in_units(), kinds(), rules_);
  if (!made) return made.error();
  std::vector<std::string> names;
  std::map<std::string, VertexId, std::less<>> by_name;
  for (const VertexId pose : IdRange<VertexId>(made->roadmap()->num_vertices())) {
    const VertexId place = made->place(pose);
    names.push_back(places_.name(place) + " facing " + to_string(Radians(made->heading(pose))));
    if (!(*places_.names_)[place.index()].empty()) by_name.emplace(names.back(), pose);
  }
  Roadmap roadmap = places_;
  roadmap.roads_ = made->roadmap();
  roadmap.turns_ = made->turns();
  roadmap.names_ = std::make_shared<const std::vector<std::string>>(std::move(names));
  roadmap.by_name_ =
      std::make_shared<const std::map<std::string, VertexId, std::less<>>>(std::move(by_name));
  return PoseRoadmap(std::move(roadmap), std::move(made).value());
}

}  // namespace quadrille::fleet
