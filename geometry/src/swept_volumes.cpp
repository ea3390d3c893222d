// SPDX-License-Identifier: MIT
#include "quadrille/geometry/swept_volumes.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

#include <algorithm>

#include "planar.hpp"
#include "quadrille/core/contract.hpp"
#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

struct Box {
  Point low;
  Point high;
};

Box box_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return {{-disc->radius, -disc->radius}, {disc->radius, disc->radius}};
  const std::vector<Point>& vertices = std::get<ConvexPolygon>(body).vertices();
  Box box{vertices[0], vertices[0]};
  for (const Point& p : vertices) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

// What a body sweeps, as the tree sees it: its bounding box, and the motion's index. FCL would
// bound a turned capsule or hull by the box of its bounding sphere; the box that is set here is
// tight, and its corners are integers below 2^53, hence not rounded. Nothing asks for the shape
// itself.
class SweptObject : public fcl::CollisionObjectd {
 public:
  SweptObject(std::shared_ptr<fcl::CollisionGeometryd> any_shape, const Box& body,
              const Motion& motion, std::size_t index)
      : fcl::CollisionObjectd(std::move(any_shape)), index_(index) {
    const Vec low = to_vec(body.low + Point{std::min(motion.from.x, motion.to.x),
                                            std::min(motion.from.y, motion.to.y)});
    const Vec high = to_vec(body.high + Point{std::max(motion.from.x, motion.to.x),
                                              std::max(motion.from.y, motion.to.y)});
    aabb = fcl::AABBd(fcl::Vector3d(low.x, low.y, 0), fcl::Vector3d(high.x, high.y, 0));
  }

  [[nodiscard]] std::size_t index() const noexcept { return index_; }

 private:
  std::size_t index_;
};

struct Query {
  const BodyPair& pair;
  const Motion& motion;
  const std::vector<Motion>& motions;
  std::vector<std::size_t> found;
};

bool visit(fcl::CollisionObjectd* object, fcl::CollisionObjectd* /*query*/, void* data) {
  Query& query = *static_cast<Query*>(data);
  const std::size_t index = static_cast<const SweptObject*>(object)->index();
  if (query.pair.can_meet(query.motion, query.motions[index])) query.found.push_back(index);
  return false;  // Go on.
}

}  // namespace

class SweptVolumes::Tree {
 public:
  Tree(const Body& body, std::vector<Motion> motions)
      : body_(body), motions_(std::move(motions)), any_shape_(std::make_shared<fcl::Sphered>(1)) {
    const Box box = box_of(body_);
    std::vector<fcl::CollisionObjectd*> all;
    objects_.reserve(motions_.size());
    for (const Motion& motion : motions_) {
      QUADRILLE_REQUIRE(is_valid(motion), "a motion is outside the supported range");
      objects_.push_back(std::make_unique<SweptObject>(any_shape_, box, motion, objects_.size()));
      all.push_back(objects_.back().get());
    }
    if (!all.empty()) manager_.registerObjects(all);
    manager_.setup();
  }

  [[nodiscard]] const std::vector<Motion>& motions() const noexcept { return motions_; }

  [[nodiscard]] std::vector<std::size_t> near(const Body& visitor, const Motion& motion) const {
    const BodyPair pair(visitor, body_);
    // A shape of its own, because the constructor writes to it.
    SweptObject object(std::make_shared<fcl::Sphered>(1), box_of(visitor), motion, 0);
    Query query{pair, motion, motions_, {}};
    manager_.collide(&object, &query, visit);
    std::sort(query.found.begin(), query.found.end());
    return std::move(query.found);
  }

 private:
  Body body_;
  std::vector<Motion> motions_;
  std::shared_ptr<fcl::CollisionGeometryd> any_shape_;
  std::vector<std::unique_ptr<SweptObject>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

SweptVolumes::SweptVolumes(const Body& body, std::vector<Motion> motions)
    : tree_(std::make_unique<Tree>(body, std::move(motions))) {}
SweptVolumes::~SweptVolumes() = default;
SweptVolumes::SweptVolumes(SweptVolumes&&) noexcept = default;
SweptVolumes& SweptVolumes::operator=(SweptVolumes&&) noexcept = default;

const std::vector<Motion>& SweptVolumes::motions() const noexcept { return tree_->motions(); }

std::vector<std::size_t> SweptVolumes::near(const Body& visitor, const Motion& motion) const {
  QUADRILLE_REQUIRE(is_valid(motion), "a motion is outside the supported range");
  return tree_->near(visitor, motion);
}

std::vector<std::size_t> SweptVolumes::near(const Body& visitor, std::size_t index) const {
  QUADRILLE_REQUIRE(index < motions().size(), "no such motion");
  return tree_->near(visitor, motions()[index]);
}

}  // namespace quadrille::geometry
