// SPDX-License-Identifier: MIT
#include "quadrille/exports/samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "quadrille/continuous/quantise.hpp"

namespace quadrille::exports {

using continuous::Path;
using continuous::Stop;
using continuous::Ticks;

namespace {

/// Of an angle that differs by less one cannot say whether it is half a turn.
constexpr double kSameHeading = 1e-7;

/// The same angle in [-pi, pi].
double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

double angle_of(continuous::Heading heading) noexcept {
  return wrapped(static_cast<double>(heading) * std::numbers::pi / 2);
}

Yaws yaws_of(const continuous::PoseGrid& poses) {
  Yaws yaws;
  for (const VertexId v : IdRange<VertexId>(poses.roadmap()->num_vertices()))
    yaws.push_back(angle_of(poses.pose(v).heading));
  return yaws;
}

Yaws yaws_of(const continuous::PoseRoadmap& poses) {
  Yaws yaws;
  for (const VertexId v : IdRange<VertexId>(poses.roadmap()->num_vertices()))
    yaws.push_back(wrapped(poses.heading(v)));
  return yaws;
}

std::vector<Sample> Sampler::samples(AgentId agent, const Path& path) {
  samples_.clear();
  next_ = 0;
  const continuous::Agent& made = instance_.agent(agent);
  turns_ = std::holds_alternative<geometry::Disc>(made.body) ||
           (yaws_ != nullptr && !made.shapes.empty());
  yaw_ = first_yaw(path);
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    add({path[k].vertex, path[k].vertex, path[k].arrive, path[k].depart, yaw_});
    const Leg move = leg(path[k], path[k + 1]);
    add(move);
    yaw_ = wrapped(move.yaw + move.turn);
  }
  samples_.push_back(at(path.back().vertex, path.back().arrive, yaw_));
  return samples_;
}

double Sampler::units(Ticks ticks) const {
  return continuous::in_input_units(ticks, instance_.resolution());
}

Sample Sampler::at(VertexId vertex, Ticks time, double yaw) const {
  const auto& p = instance_.roadmap().position(vertex);
  const auto& resolution = instance_.resolution();
  Sample sample;
  sample.time = units(time);
  sample.x = continuous::in_input_units(p.x, resolution);
  sample.y = continuous::in_input_units(p.y, resolution);
  sample.z = continuous::in_input_units(p.z, resolution);
  sample.yaw = yaw;
  return sample;
}

Sampler::Leg Sampler::leg(const Stop& from, const Stop& to) const {
  Leg leg{from.vertex, to.vertex, from.depart, to.arrive, yaw_};
  if (!turns_) return leg;
  if (yaws_ != nullptr) {
    leg.yaw = (*yaws_)[from.vertex];
    leg.turn = wrapped((*yaws_)[to.vertex] - leg.yaw);
    if (leg.turn < -std::numbers::pi + kSameHeading) leg.turn += 2 * std::numbers::pi;
    return leg;
  }
  const auto& p = instance_.roadmap().position(from.vertex);
  const auto& q = instance_.roadmap().position(to.vertex);
  // Straight up, or nowhere: as before.
  if (p.x == q.x && p.y == q.y) return leg;
  leg.yaw = std::atan2(static_cast<double>((q.y - p.y).value()),
                       static_cast<double>((q.x - p.x).value()));
  return leg;
}

double Sampler::first_yaw(const Path& path) const {
  if (!turns_) return 0;
  if (yaws_ != nullptr) return (*yaws_)[path.front().vertex];
  const auto& roadmap = instance_.roadmap();
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const auto& p = roadmap.position(path[k].vertex);
    const auto& q = roadmap.position(path[k + 1].vertex);
    if (p.x != q.x || p.y != q.y) return leg(path[k], path[k + 1]).yaw;
  }
  return 0;
}

void Sampler::add(const Leg& leg) {
  if (leg.begin == leg.end) return;
  const Sample start = at(leg.from, leg.begin, leg.yaw), stop = at(leg.to, leg.end, leg.yaw);
  const double lasts = stop.time - start.time;
  Sample sample = start;
  sample.vx = (stop.x - start.x) / lasts;
  sample.vy = (stop.y - start.y) / lasts;
  sample.vz = (stop.z - start.z) / lasts;
  sample.turning = leg.turn / lasts;
  samples_.push_back(sample);
  next_ = std::max(next_, static_cast<std::int64_t>(std::floor(start.time * rate_)) + 1);
  for (; static_cast<double>(next_) / rate_ < stop.time; ++next_) {
    sample.time = static_cast<double>(next_) / rate_;
    const double since = sample.time - start.time;
    if (since <= 0) continue;
    sample.x = start.x + sample.vx * since;
    sample.y = start.y + sample.vy * since;
    sample.z = start.z + sample.vz * since;
    sample.yaw = wrapped(start.yaw + sample.turning * since);
    samples_.push_back(sample);
  }
}

}  // namespace quadrille::exports
