// SPDX-License-Identifier: MIT
#include "quadrille/geometry/swept_volumes.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>

#include "pair_shape.hpp"
#include "quadrille/core/contract.hpp"
#include "swept_shapes.hpp"

namespace quadrille::geometry {
namespace {

fcl::Vector3d vector_of(const Point& p) {
  const Vec3 v = to_vec3(p);
  return {v.x, v.y, v.z};
}

// The line as the tree sees it: its bounding box, and the motion's index. FCL would bound a turned
// capsule by the box of its bounding sphere; the box that is set here is tight, and its corners are
// integers below 2^53, hence not rounded. Nothing asks for the shape.
class LineBox : public fcl::CollisionObjectd {
 public:
  // `low` and `high`: what is added to the line's box.
  LineBox(std::shared_ptr<fcl::CollisionGeometryd> any_shape, const Motion& motion,
          std::size_t index, const Point& low = {}, const Point& high = {})
      : fcl::CollisionObjectd(std::move(any_shape)), index_(index) {
    const fcl::Vector3d from = vector_of(motion.from), to = vector_of(motion.to);
    aabb = fcl::AABBd(from.cwiseMin(to) + vector_of(low), from.cwiseMax(to) + vector_of(high));
  }

  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

}  // namespace

class SweptVolumes::Tree {
 public:
  explicit Tree(std::vector<Motion> motions)
      : motions_(std::move(motions)), any_shape_(std::make_shared<fcl::Sphered>(1)) {
    std::vector<fcl::CollisionObjectd*> all;
    objects_.reserve(motions_.size());
    for (const Motion& motion : motions_) {
      QUADRILLE_REQUIRE(is_valid(motion), "a motion is outside the supported range");
      objects_.push_back(std::make_unique<LineBox>(any_shape_, motion, objects_.size()));
      all.push_back(objects_.back().get());
    }
    if (!all.empty()) manager_.registerObjects(all);
    manager_.setup();
  }

  [[nodiscard]] const std::vector<Motion>& motions() const noexcept { return motions_; }

  [[nodiscard]] std::vector<Nearby> near(const Motion& motion, const BodyPair& bodies,
                                         Tally* tally) const {
    Query query(motions_, motion, bodies);
    LineBox box = query.box();
    manager_.collide(&box, &query, visit);
    std::sort(query.found.begin(), query.found.end(),
              [](const Nearby& a, const Nearby& b) { return a.index < b.index; });
    if (tally != nullptr) {
      const Tally& now = query.tally;
      tally->by_boxes += motions_.size() - query.num_seen;
      tally->apart += now.apart;
      tally->by_nearest += now.by_nearest;
      tally->by_hulls += now.by_hulls;
      tally->sure += now.sure;
      tally->doubtful += now.doubtful;
    }
    return std::move(query.found);
  }

 private:
  /// One motion with both bodies, and the lines around it.
  struct Query {
    Query(const std::vector<Motion>& all, const Motion& one, const BodyPair& bodies)
        : motions(all),
          motion(one),
          line(one, one.from),
          shape(bodies.shape_.get()),
          reach(bodies.reach_) {
      if (shape != nullptr) hull.emplace(motion, shape->corners(), reach);
    }

    /// Of its line with both bodies around.
    [[nodiscard]] LineBox box() const {
      Point low, high;
      if (shape != nullptr) low = high = shape->corners().front();
      for (const Point& corner : corners()) {
        low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
        high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
      }
      const Point margin{reach, reach, reach};
      // A shape of its own, because the constructor writes to it.
      return LineBox(std::make_shared<fcl::Sphered>(1), motion, 0, low - margin, high + margin);
    }
    [[nodiscard]] std::span<const Point> corners() const {
      return shape != nullptr ? std::span<const Point>(shape->corners()) : std::span<const Point>();
    }

    void look(std::size_t index) {
      ++num_seen;
      const Motion& other = motions[index];
      if (shape != nullptr)
        QUADRILLE_REQUIRE(is_level(motion, other), "a polygon stays at one height");
      const SweptLine other_line(other, motion.from);
      const double error = distance_error(line, other_line);
      const LineDistance apart = distance(line, other_line);
      if (apart.distance >= outer() + error) {
        ++tally.apart;
      } else if (meet_where_nearest(apart, error)) {
        add(index, true);
      } else if (shape != nullptr) {
        look_at_hulls(index, {apart.between.x, apart.between.y});
      } else {
        add(index, false);
      }
    }

    // FCL comes last: it takes longest. The direction between the nearest points of the lines is a
    // first guess; where it leaves the hulls in touch, as far as FCL can see, there is no better.
    void look_at_hulls(std::size_t index, Vec between) {
      const Motion& other = motions[index];
      const double clearance = hull->clearance(other, between);
      if (clearance >= 0) {
        ++tally.by_nearest;
      } else if (shape->meet_at_ends(motion, other)) {
        add(index, true);
      } else if (clearance < -hull->tolerance() &&
                 hull->clearance(other, hull->direction(other)) >= 0) {
        ++tally.by_hulls;
      } else {
        add(index, false);
      }
    }

    void add(std::size_t index, bool is_sure) {
      ++(is_sure ? tally.sure : tally.doubtful);
      found.push_back({index, is_sure});
    }

    // Lines that are farther from each other do not meet.
    [[nodiscard]] double outer() const {
      return static_cast<double>(reach.value()) + (shape != nullptr ? shape->outer() : 0);
    }
    [[nodiscard]] bool meet_where_nearest(const LineDistance& apart, double error) const {
      const double inner = shape != nullptr ? shape->inner() : 0;
      if (inner >= 0 && apart.distance < static_cast<double>(reach.value()) + inner - error)
        return true;
      return shape != nullptr && shape->contains({apart.between.x, apart.between.y}, error);
    }

    const std::vector<Motion>& motions;
    const Motion& motion;
    const SweptLine line;
    const BodyPair::Shape* const shape;  // null for two discs
    const Length reach;
    std::optional<SweptHull> hull;  // of the shape
    std::vector<Nearby> found;
    std::size_t num_seen = 0;
    Tally tally;
  };

  static bool visit(fcl::CollisionObjectd* object, fcl::CollisionObjectd* /*query*/, void* data) {
    static_cast<Query*>(data)->look(static_cast<const LineBox*>(object)->index());
    return false;  // Go on.
  }

  std::vector<Motion> motions_;
  std::shared_ptr<fcl::CollisionGeometryd> any_shape_;
  std::vector<std::unique_ptr<LineBox>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

SweptVolumes::SweptVolumes(std::vector<Motion> motions)
    : tree_(std::make_unique<Tree>(std::move(motions))) {}
SweptVolumes::~SweptVolumes() = default;
SweptVolumes::SweptVolumes(SweptVolumes&&) noexcept = default;
SweptVolumes& SweptVolumes::operator=(SweptVolumes&&) noexcept = default;

const std::vector<Motion>& SweptVolumes::motions() const noexcept { return tree_->motions(); }

std::vector<SweptVolumes::Nearby> SweptVolumes::near(const Motion& motion, const BodyPair& bodies,
                                                     Tally* tally) const {
  QUADRILLE_REQUIRE(is_valid(motion), "a motion is outside the supported range");
  return tree_->near(motion, bodies, tally);
}

}  // namespace quadrille::geometry
