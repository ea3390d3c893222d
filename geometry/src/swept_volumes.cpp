// SPDX-License-Identifier: MIT
#include "quadrille/geometry/swept_volumes.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "quadrille/core/contract.hpp"
#include "space.hpp"

namespace quadrille::geometry {
namespace {

fcl::Vector3d vector_of(const Point& p) {
  const Vec3 v = to_vec3(p);
  return {v.x, v.y, v.z};
}

/// The line of a motion as FCL has it, seen from `origin`: a capsule without a radius.
struct Line {
  Line(const Motion& motion, const Point& origin)
      : from(vector_of(motion.from - origin)), to(vector_of(motion.to - origin)) {
    const fcl::Vector3d along = to - from;
    capsule.lz = along.norm();
    if (capsule.lz > 0)
      frame.linear() = Eigen::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), along).matrix();
    frame.translation() = (from + to) / 2;
  }
  [[nodiscard]] double extent() const {
    return std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
  }

  fcl::Vector3d from, to;
  fcl::Capsuled capsule{0, 0};
  fcl::Transform3d frame = fcl::Transform3d::Identity();
};

double distance(const Line& a, const Line& b) {
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(&a.capsule, a.frame, &b.capsule, b.frame, request, result);
}

// FCL's closed form gives the distance of two points of the lines, the first at a share s of its
// line from a quotient whose denominator is |a|^2 |b|^2 sin^2 of the angle between them. With u =
// 2^-53 and S the extent, rounding moves s |a| by at most 12 u S / (sin^2 - 4 u), which adds at
// most 300 u S^2 to the square of the distance if sin^2 is at least 8 u; else the lines part by
// less than sqrt(8 u) S along all of their length, and any s will do. The distance is too large by
// at most sqrt(300 u) S < 2^-22 S therefore, and too small by a few u S, which the capsules' ends
// and the arithmetic cost.
double error_of(const Line& a, const Line& b) { return 0x1p-21 * std::max(a.extent(), b.extent()); }

// The line as the tree sees it: its bounding box, and the motion's index. FCL would bound a turned
// capsule by the box of its bounding sphere; the box that is set here is tight, and its corners are
// integers below 2^53, hence not rounded. Nothing asks for the shape.
class LineBox : public fcl::CollisionObjectd {
 public:
  LineBox(std::shared_ptr<fcl::CollisionGeometryd> any_shape, const Motion& motion, Length reach,
          std::size_t index)
      : fcl::CollisionObjectd(std::move(any_shape)), index_(index) {
    const fcl::Vector3d from = vector_of(motion.from), to = vector_of(motion.to);
    const auto margin = fcl::Vector3d::Constant(static_cast<double>(reach.count()));
    aabb = fcl::AABBd(from.cwiseMin(to) - margin, from.cwiseMax(to) + margin);
  }

  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

struct Query {
  const std::vector<Motion>& motions;
  const Point origin;
  const Line line;
  const double reach;
  std::vector<SweptVolumes::Nearby> found;
  std::size_t num_apart = 0;
};

bool visit(fcl::CollisionObjectd* object, fcl::CollisionObjectd* /*query*/, void* data) {
  Query& query = *static_cast<Query*>(data);
  const std::size_t index = static_cast<const LineBox*>(object)->index();
  const Line line(query.motions[index], query.origin);
  const double error = error_of(query.line, line), apart = distance(query.line, line);
  if (apart >= query.reach + error)
    ++query.num_apart;
  else
    query.found.push_back({index, apart < query.reach - error});
  return false;  // Go on.
}

}  // namespace

class SweptVolumes::Tree {
 public:
  explicit Tree(std::vector<Motion> motions)
      : motions_(std::move(motions)), any_shape_(std::make_shared<fcl::Sphered>(1)) {
    std::vector<fcl::CollisionObjectd*> all;
    objects_.reserve(motions_.size());
    for (const Motion& motion : motions_) {
      QUADRILLE_REQUIRE(is_valid(motion), "a motion is outside the supported range");
      objects_.push_back(std::make_unique<LineBox>(any_shape_, motion, Length{}, objects_.size()));
      all.push_back(objects_.back().get());
    }
    if (!all.empty()) manager_.registerObjects(all);
    manager_.setup();
  }

  [[nodiscard]] const std::vector<Motion>& motions() const noexcept { return motions_; }

  [[nodiscard]] std::vector<Nearby> near(const Motion& motion, Length reach, Tally* tally) const {
    // A shape of its own, because the constructor writes to it.
    LineBox box(std::make_shared<fcl::Sphered>(1), motion, reach, 0);
    Query query{
        motions_, motion.from, Line(motion, motion.from), static_cast<double>(reach.count()), {}};
    manager_.collide(&box, &query, visit);
    std::sort(query.found.begin(), query.found.end(),
              [](const Nearby& a, const Nearby& b) { return a.index < b.index; });
    if (tally != nullptr) {
      tally->by_boxes += motions_.size() - query.found.size() - query.num_apart;
      tally->apart += query.num_apart;
      for (const Nearby& found : query.found) ++(found.is_sure ? tally->sure : tally->doubtful);
    }
    return std::move(query.found);
  }

 private:
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

std::vector<SweptVolumes::Nearby> SweptVolumes::near(const Motion& motion, Length reach,
                                                     Tally* tally) const {
  QUADRILLE_REQUIRE(is_valid(motion), "a motion is outside the supported range");
  QUADRILLE_REQUIRE(0 <= reach && reach <= 4 * kMaxLength,
                    "a reach is outside the supported range");
  return tree_->near(motion, reach, tally);
}

}  // namespace quadrille::geometry
