// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/core/export.hpp"
#include "quadrille/geometry/encounter.hpp"

QUADRILLE_API_BEGIN

namespace quadrille::continuous {

/// Two bodies that touch or collide.
struct Meeting {
  AgentId agent;
  std::optional<AgentId> other;         ///< Larger than `agent`; none: an obstacle.
  std::optional<std::size_t> obstacle;  ///< Its number.
  bool collide = false;                 ///< Otherwise they touch, to within the tolerance.
  /// When the two legs are under way at the same time: the first ones that collide, or that touch
  /// if none do.
  Ticks begin = 0, end = 0;
};

/// What FCL says of a plan.
struct SecondOpinion {
  enum class Verdict {
    clear,      ///< A plan: everybody is apart at all times.
    touch,      ///< To within the tolerance a plan in which some touch.
    collision,  ///< No plan: some collide.
    broken,     ///< No plan: a path breaks a rule.
  };
  Verdict verdict = Verdict::clear;
  std::vector<std::string> broken;  ///< A sentence for each path that breaks a rule.
  std::vector<Meeting> meetings;    ///< Of sound paths, by agent, then others, then obstacles.
  double tolerance = 0;             ///< Length units: the largest of all pairs of bodies.
  std::size_t num_looks = 0;        ///< Pairs of legs that are under way at some common moment.
};
[[nodiscard]] std::string_view to_string(SecondOpinion::Verdict verdict) noexcept;

/// A second opinion on a plan, beside `verify`: the rules of the paths with code of its own, and
/// FCL's opinion (geometry::EncounterCheck) on each two legs that are under way at the same time,
/// stays included, of agents and of obstacles. It looks at no samples, and is as exact as floating
/// point and FCL are, to within `tolerance`: where `verify` finds a plan it never says `collision`,
/// and where `verify` finds a collision it never says `clear`. Takes any plan, however broken. Time
/// is proportional to pairs of agents times stops.
[[nodiscard]] SecondOpinion ask_fcl(const Instance& instance, const Plan& plan);

/// How `verify`, which found violations or none, and FCL contradict each other beyond the
/// tolerance; empty if they do not.
[[nodiscard]] std::string find_contradiction(bool is_valid, const SecondOpinion& opinion);

}  // namespace quadrille::continuous

QUADRILLE_API_END
