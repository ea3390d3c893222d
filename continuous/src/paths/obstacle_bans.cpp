// SPDX-License-Identifier: MIT
#include "paths/obstacle_bans.hpp"

#include <algorithm>

#include "model/shape_pairs.hpp"
#include "paths/unsafe_starts.hpp"

namespace quadrille::continuous {
namespace {

/// Of one obstacle, for one class.
class ObstacleBans {
 public:
  ObstacleBans(const Instance& instance, ClassId c, const Body& obstacle, LimitMonitor& limits,
               std::vector<Ban>& bans)
      : instance_(instance),
        class_(c),
        limits_(limits),
        bodies_({obstacle}, instance.bodies(c)),
        swapped_(instance.bodies(c), {obstacle}),
        bans_(bans) {}

  void add_move(const geometry::Motion& motion, Ticks begin) {
    const ShapePairs::Move move{{}, motion};
    for (const EdgeId e : edges()) {
      const ShapePairs::Move own = move_of(instance_, class_, e);
      if (!may_use(e) || !bodies_.can_meet(move, own)) continue;
      if (const auto offsets = bodies_.unsafe_offsets(move, own))
        bans_.push_back(Ban::start(e, starts_against(*offsets, begin)));
    }
    for (const VertexId v : vertices())
      if (const auto window = bodies_.contact_window(move, stand(v)))
        bans_.push_back(Ban::stay(v, window->shifted(begin)));
  }

  // Whoever comes or goes meanwhile does so as a move: a ban of the stay itself is for those who
  // are there all the time.
  void add_rest(const Point& at, Ticks begin, Ticks end) {
    const ShapePairs::Move rest{{}, geometry::rest(at, 1)};
    const ShapePairs::Stand there{{}, at};
    for (const EdgeId e : edges()) {
      const ShapePairs::Move own = move_of(instance_, class_, e);
      if (!may_use(e) || !bodies_.can_meet(rest, own)) continue;
      if (const auto window = swapped_.contact_window(own, there))
        bans_.push_back(Ban::start(e, starts_meeting(*window, begin, end)));
    }
    for (const VertexId v : vertices())
      if (bodies_.overlap(there, stand(v))) bans_.push_back(Ban::stay(v, {begin, end}));
  }

 private:
  [[nodiscard]] IdRange<EdgeId> edges() {
    limits_.check();
    return IdRange<EdgeId>(instance_.roadmap().num_edges());
  }
  [[nodiscard]] IdRange<VertexId> vertices() const {
    return IdRange<VertexId>(instance_.roadmap().num_vertices());
  }
  [[nodiscard]] bool may_use(EdgeId e) const { return instance_.may_use(class_, e); }
  [[nodiscard]] ShapePairs::Stand stand(VertexId v) const {
    return stand_at(instance_.roadmap(), v);
  }

  const Instance& instance_;
  const ClassId class_;
  LimitMonitor& limits_;
  ShapePairs bodies_, swapped_;
  std::vector<Ban>& bans_;
};

}  // namespace

std::vector<Ban> bans_around_obstacles(const Instance& instance, ClassId c, LimitMonitor& limits) {
  std::vector<Ban> bans;
  for (const MovingObstacle& obstacle : instance.obstacles()) {
    ObstacleBans of_one(instance, c, obstacle.body, limits, bans);
    for (std::size_t k = 0; k < obstacle.path.size(); ++k) {
      const MovingObstacle::Stop& stop = obstacle.path[k];
      const bool is_last = k + 1 == obstacle.path.size();
      const Ticks until = is_last && !obstacle.leaves ? kForever : stop.depart;
      if (until > stop.arrive) of_one.add_rest(stop.at, stop.arrive, until);
      if (is_last) continue;
      const MovingObstacle::Stop& next = obstacle.path[k + 1];
      of_one.add_move({stop.at, next.at, next.arrive - stop.depart}, stop.depart);
    }
  }
  std::sort(bans.begin(), bans.end());
  return bans;
}

}  // namespace quadrille::continuous
