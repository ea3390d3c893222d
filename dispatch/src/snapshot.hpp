// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "quadrille/continuous/instance.hpp"
#include "quadrille/continuous/plan.hpp"
#include "quadrille/dispatch/course.hpp"

namespace quadrille::dispatch {

using continuous::Instance;
using continuous::LanePlace;
using continuous::Roadmap;

/// A fleet at one moment of its courses: an instance that begins then, where each robot is then,
/// and what is left of the courses as its plan. Robots that are moving finish their moves.
struct Snapshot {
  Instance instance;
  continuous::Plan plan;

  /// What a path of the instance means.
  [[nodiscard]] Course course(const continuous::Path& path) const;
};

/// `agents`: one per course, whose starts are set. Goals, releases and deadlines stay what they
/// are. Edges in `closed` are open to nobody, but courses may lead there. Errors: those of
/// Instance::make.
[[nodiscard]] Result<Snapshot> take_snapshot(const std::shared_ptr<const Roadmap>& roadmap,
                                             const continuous::Resolution& resolution,
                                             std::vector<continuous::Agent> agents,
                                             std::span<const Course> courses, Ticks moment,
                                             std::span<const continuous::EdgeId> closed = {});

/// The same, with the ends of the courses as goals.
[[nodiscard]] Result<Snapshot> take_snapshot_of_ends(const std::shared_ptr<const Roadmap>& roadmap,
                                                     const continuous::Resolution& resolution,
                                                     std::vector<continuous::Agent> agents,
                                                     std::span<const Course> courses, Ticks moment);

}  // namespace quadrille::dispatch
