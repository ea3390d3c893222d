// SPDX-License-Identifier: MIT
#include "place_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace quadrille::fleet {
namespace {

/// The effort for looking again, where there is neither a first plan nor a proof at once.
constexpr std::int64_t kMaxConflicts = 2'000;
constexpr double kAnyGap = 1e9;

std::vector<AgentId> all_of(const Fleet& fleet) {
  std::vector<AgentId> all;
  for (const AgentId id : fleet.robot_ids()) all.push_back(id);
  return all;
}

}  // namespace

PlaceRounding::Smaller PlaceRounding::smaller(const Fleet::Parts& parts,
                                              const std::vector<AgentId>& whom) {
  Smaller result;
  for (const AgentId i : whom) {
    result.agents.push_back(parts.agents[i.index()]);
    const double off = std::ceil(parts.off[i.index()]);
    if (off <= 0) continue;
    result.most = std::max(result.most, off);
    if (auto* const disc = std::get_if<continuous::Disc>(&result.agents.back().body))
      disc->radius = std::max(continuous::Length(1),
                              disc->radius - continuous::Length(static_cast<std::int64_t>(off)));
    else
      result.has_polygons = true;
  }
  return result;
}

Result<continuous::Instance> PlaceRounding::make(const Fleet::Parts& parts,
                                                 const Smaller& smaller) const {
  return continuous::Instance::make(parts.roads, smaller.agents, fleet_.roadmap().unit_sizes(), {},
                                    parts.obstacles, parts.now);
}

std::string PlaceRounding::say(const Smaller& smaller, bool is_sure) const {
  const Metres most = smaller.most * fleet_.roadmap().resolution().length;
  return std::string(is_sure ? "; this rests" : "; this may rest") +
         " on the rounding of places in the middle of moves, by up to " + to_string(most) +
         (is_sure ? ": it is not so with bodies that are smaller by that" : "");
}

std::string PlaceRounding::doubt_about_refusal() const {
  const auto parts = fleet_.parts();
  if (!parts) return "";
  const Smaller smaller = PlaceRounding::smaller(*parts, all_of(fleet_));
  if (smaller.most == 0) return "";
  if (make(*parts, smaller)) return say(smaller, true);
  return smaller.has_polygons ? say(smaller, false) : "";
}

std::string PlaceRounding::doubt_about(std::vector<AgentId> blocked,
                                       const quadrille::Limits& limits) const {
  const auto parts = fleet_.parts();
  if (!parts) return "";
  if (blocked.empty()) blocked = all_of(fleet_);
  const Smaller smaller = PlaceRounding::smaller(*parts, blocked);
  if (smaller.most == 0) return "";
  const auto instance = make(*parts, smaller);
  if (!instance) return "";
  continuous::SolveOptions options;
  options.gap_percent = kAnyGap;
  options.limits = limits;
  options.limits.conflicts = kMaxConflicts;
  const auto again = continuous::solve(*instance, options);
  if (!again || (again->status == Status::infeasible && !smaller.has_polygons)) return "";
  return say(smaller, again->plan.has_value());
}

}  // namespace quadrille::fleet
