// SPDX-License-Identifier: MIT
#include "fleets/dispatch_words.hpp"

#include <cmath>

#include "quadrille/core/decimal.hpp"

namespace quadrille::cli {
namespace {

using Json = DispatchWords::Json;

Error unknown(const std::string& what) { return {ErrorCode::invalid_instance, what, {}}; }

}  // namespace

DispatchWords::DispatchWords(const LiveFleet& fleet, const text::Names& names)
    : fleet_(fleet), names_(names) {
  for (std::size_t i = 0; i < fleet.num_robots(); ++i)
    if (const std::string* const name = names.agent(i)) robots_.emplace(*name, AgentId(i));
  for (std::size_t v = 0; v < names.vertices.size(); ++v)
    vertices_.emplace(Json::parse(names.vertices[v]), VertexId(v));
}

Result<AgentId> DispatchWords::robot(const Json& called) const {
  if (called.is_string())
    if (const auto known = robots_.find(called.get<std::string>()); known != robots_.end())
      return known->second;
  if (called.is_number_integer() && called >= 0 && called < fleet_.num_robots())
    return AgentId(called.get<std::size_t>());
  return unknown("there is no robot " + called.dump());
}

Result<VertexId> DispatchWords::vertex(const Json& called) const {
  if (const auto known = vertices_.find(called); known != vertices_.end()) return known->second;
  if (called.is_number_integer() && called >= 0 && called < fleet_.num_vertices())
    return VertexId(called.get<std::size_t>());
  return unknown("there is no vertex " + called.dump());
}

Result<dispatch::Ticks> DispatchWords::ticks(const Json& time, const std::string& what,
                                             bool is_up) const {
  // What differs from a whole tick by a millionth of one is meant to be that.
  constexpr double kNear = 1e-6, kLongest = 1e15;
  if (!time.is_number()) return unknown("\"" + what + "\" is a number");
  const double exact = time.get<double>() / fleet_.tick_size();
  const double whole = is_up ? std::ceil(exact - kNear) : std::floor(exact + kNear);
  if (!(whole >= 0 && whole <= kLongest))
    return Error{ErrorCode::out_of_range,
                 "\"" + what + "\" is negative or too long: " + decimal(time.get<double>()),
                 {}};
  return Ticks(static_cast<std::int64_t>(whole));
}

Json DispatchWords::robot(AgentId robot) const {
  const std::string* const name = names_.agent(robot.index());
  return name != nullptr ? Json(*name) : Json(robot.value());
}

Json DispatchWords::vertex(VertexId vertex) const {
  if (vertex.index() >= names_.vertices.size()) return vertex.value();
  return Json::parse(names_.vertices[vertex.index()]);
}

double DispatchWords::time(Ticks ticks) const { return fleet_.units(ticks); }

Json DispatchWords::stop(const dispatch::Stop& stop) const {
  Json json = {{"vertex", vertex(stop.spot.from)}};
  if (!stop.spot.is_vertex()) {
    json["to"] = vertex(stop.spot.to);
    json["fraction"] = static_cast<double>(stop.spot.behind.value()) /
                       static_cast<double>(stop.spot.whole.value());
  }
  json["arrive"] = time(stop.arrive);
  json["depart"] = time(stop.depart);
  return json;
}

Json DispatchWords::position(const dispatch::Spot& spot) const {
  const auto place = fleet_.position(spot);
  if (!place) return Json::array();
  return {static_cast<float>((*place)[0]), static_cast<float>((*place)[1])};
}

std::string DispatchWords::participant(AgentId robot) const {
  const std::string* const name = names_.agent(robot.index());
  return name != nullptr ? *name : "agent" + std::to_string(robot.value());
}

}  // namespace quadrille::cli
