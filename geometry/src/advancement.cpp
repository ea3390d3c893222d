// SPDX-License-Identifier: MIT
#include "advancement.hpp"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <exception>

#include "fcl_shapes.hpp"

namespace quadrille::geometry {
namespace {

// More directions than these are not worth it: the exact predicate is cheaper.
constexpr int kMaxSteps = 8;

Length size_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body)) return disc->radius;
  Length size = 0;
  for (const Point& vertex : std::get<ConvexPolygon>(body).vertices())
    size = std::max(size, extent(vertex));
  return size;
}

std::shared_ptr<fcl::CollisionGeometryd> make_geometry(const Body& body, double scale) {
  if (const auto* disc = std::get_if<Disc>(&body))
    return std::make_shared<fcl::Sphered>(scale * static_cast<double>(disc->radius.value()));
  return make_prism(std::get<ConvexPolygon>(body).vertices(), scale, 1);
}

}  // namespace

// In a length unit in which both bodies are at most 1 large: FCL's tolerances are absolute.
struct Advancement::Shapes {
  double scale;
  std::shared_ptr<fcl::CollisionGeometryd> a;
  std::shared_ptr<fcl::CollisionGeometryd> b;

  Shapes(const Body& body_a, const Body& body_b)
      : scale(1 / static_cast<double>(std::max(size_of(body_a), size_of(body_b)).value())),
        a(make_geometry(body_a, scale)),
        b(make_geometry(body_b, scale)) {}

  // From a to b where b is at `place` relative to a; none if FCL finds no distance.
  [[nodiscard]] std::optional<Vec> direction(Vec place) const {
    fcl::DistanceRequestd request(/*enable_nearest_points=*/true);
    fcl::DistanceResultd result;
    fcl::Transform3d at_b = fcl::Transform3d::Identity();
    at_b.translation() = fcl::Vector3d(scale * place.x, scale * place.y, 0);
    try {
      // Thrown by FCL when libccd's iteration degenerates. Whatever it is: nothing is proved.
      if (!(fcl::distance(a.get(), fcl::Transform3d::Identity(), b.get(), at_b, request, result) >
            0))
        return std::nullopt;
    } catch (const std::exception&) {
      return std::nullopt;
    }
    const fcl::Vector3d between = result.nearest_points[1] - result.nearest_points[0];
    const Vec flat{between.x(), between.y()};
    const double length = norm(flat);
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return (1 / length) * flat;
  }
};

Advancement::Advancement(const Body& a, const Body& b, std::span<const Point> shape, Length reach)
    : shapes_(std::make_unique<const Shapes>(a, b)), reach_(static_cast<double>(reach.value())) {
  for (const Point& corner : shape) shape_.push_back(to_vec(corner));
}

Advancement::~Advancement() = default;

// For a unit vector n, every point within `reach` of the shape has n . point <= support + reach.
// Where the path is beyond that, the bodies are apart; n . path is linear, so a single direction
// proves a whole stretch of the path, up to where the excess falls to zero.
bool Advancement::proves_apart(const RelativePath& path) const {
  double done = 0;  // The fraction of the path that is proved.
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec here = path.begin + done * (path.end - path.begin);
    const std::optional<Vec> n = shapes_->direction(here);
    if (!n) return false;
    double support = -std::numeric_limits<double>::infinity();
    for (const Vec corner : shape_) support = std::max(support, dot(*n, corner));
    const double bound = support + reach_ + path.error;
    if (!(dot(*n, here) > bound)) return false;
    const double excess_begin = dot(*n, path.begin) - bound;
    const double excess_end = dot(*n, path.end) - bound;
    if (excess_end > 0) return true;
    const double proved = excess_begin / (excess_begin - excess_end);
    if (!(proved > done)) return false;
    done = proved;
  }
  return false;
}

}  // namespace quadrille::geometry
