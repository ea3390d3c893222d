// SPDX-License-Identifier: MIT
#include "snapshot.hpp"

#include <utility>

#include "quadrille/continuous/under_way.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::dispatch {

using continuous::Agent;
using continuous::Resolution;

Course Snapshot::course(const continuous::Path& path) const {
  Course course;
  for (const continuous::Stop& stop : path) {
    const LanePlace* const on = instance.roadmap().lane_place(stop.vertex);
    course.push_back(
        {on == nullptr ? Spot(stop.vertex) : Spot{on->from, on->to, on->behind, on->whole},
         stop.arrive, stop.depart});
  }
  return course;
}

Result<Snapshot> take_snapshot(const std::shared_ptr<const Roadmap>& roadmap,
                               const Resolution& resolution, std::vector<Agent> agents,
                               std::span<const Course> courses, Ticks moment,
                               std::span<const continuous::EdgeId> closed) {
  QUADRILLE_REQUIRE(agents.size() == courses.size(), "a course for each agent");
  continuous::RoadmapParts parts(*roadmap);
  continuous::Plan plan;
  bool has_places = false;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Course rest = since(courses[i], moment);
    const Spot& here = rest.front().spot;
    agents[i].under_way = false;
    if (here.is_vertex()) {
      agents[i].start = here.from;
    } else {
      agents[i].start =
          continuous::add_lane_place(parts, here.from, here.to, here.whole, here.behind);
      agents[i].under_way = !stands_at(courses[i], moment);
      has_places = true;
    }
    continuous::Path path{{agents[i].start, rest.front().arrive, rest.front().depart}};
    for (std::size_t k = 1; k < rest.size(); ++k) {
      QUADRILLE_REQUIRE(rest[k].spot.is_vertex(), "nobody stops within a lane later on");
      path.push_back({rest[k].spot.from, rest[k].arrive, rest[k].depart});
    }
    path.back().depart = path.back().arrive;
    plan.paths.push_back(std::move(path));
  }
  std::shared_ptr<const Roadmap> roads = roadmap;
  if (has_places) {
    auto made = std::move(parts).make();
    if (!made) return made.error();
    roads = std::make_shared<const Roadmap>(std::move(made).value());
  }
  if (!closed.empty()) roads = std::make_shared<const Roadmap>(roads->with_closed(closed));
  auto instance = Instance::make(std::move(roads), std::move(agents), resolution, {}, {}, moment);
  if (!instance) return instance.error();
  return Snapshot{std::move(instance).value(), std::move(plan)};
}

Result<Snapshot> take_snapshot_of_ends(const std::shared_ptr<const Roadmap>& roadmap,
                                       const Resolution& resolution, std::vector<Agent> agents,
                                       std::span<const Course> courses, Ticks moment) {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Spot& end = courses[i].back().spot;
    QUADRILLE_REQUIRE(end.is_vertex(), "a course ends at a vertex");
    agents[i].goals = end.from;
    agents[i].release = 0;
    agents[i].deadline.reset();
  }
  return take_snapshot(roadmap, resolution, std::move(agents), courses, moment);
}

}  // namespace quadrille::dispatch
