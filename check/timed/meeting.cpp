// SPDX-License-Identifier: MIT
#include "timed/meeting.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille_check {
namespace {

__extension__ using Word = unsigned __int128;

/// Integers of 512 bits, negative ones as complements.
class Wide {
 public:
  Wide(Int value) : words_{static_cast<std::uint64_t>(value)} {  // NOLINT: a number will do
    if (value < 0) std::fill(words_.begin() + 1, words_.end(), ~std::uint64_t{0});
  }
  friend Wide operator+(const Wide& a, const Wide& b) {
    Wide sum(0);
    Word carry = 0;
    for (std::size_t k = 0; k < kWords; ++k) {
      carry += static_cast<Word>(a.words_[k]) + b.words_[k];
      sum.words_[k] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return sum;
  }
  friend Wide operator-(const Wide& a, const Wide& b) {
    Wide opposite(0);
    for (std::size_t k = 0; k < kWords; ++k) opposite.words_[k] = ~b.words_[k];
    return a + opposite + Wide(1);
  }
  friend Wide operator*(const Wide& a, const Wide& b) {
    Wide product(0);
    for (std::size_t i = 0; i < kWords; ++i) {
      if (a.words_[i] == 0) continue;
      Word carry = 0;
      for (std::size_t j = 0; i + j < kWords; ++j) {
        carry += static_cast<Word>(a.words_[i]) * b.words_[j] + product.words_[i + j];
        product.words_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
    }
    return product;
  }
  friend bool operator<(const Wide& a, const Wide& b) { return (a - b).is_negative(); }

 private:
  static constexpr std::size_t kWords = 8;
  [[nodiscard]] bool is_negative() const { return words_.back() >> 63 != 0; }
  std::array<std::uint64_t, kWords> words_{};
};

using Vector = std::array<Wide, 3>;

Wide cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
Wide dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Corners of the convex hull, counterclockwise; two or one if all are on a line or the same
/// (Andrew's monotone chain).
std::vector<Vector> hull(std::vector<Vector> points) {
  const auto is_less = [](const Vector& a, const Vector& b) {
    return a[0] < b[0] || (!(b[0] < a[0]) && a[1] < b[1]);
  };
  std::sort(points.begin(), points.end(), is_less);
  points.erase(std::unique(points.begin(), points.end(),
                           [&](const Vector& a, const Vector& b) { return !is_less(a, b); }),
               points.end());
  if (points.size() < 3) return points;
  std::vector<Vector> chain;
  const auto add = [&chain](const Vector& point, std::size_t least) {
    while (chain.size() >= least &&
           !(Wide(0) < cross(chain.back() - chain[chain.size() - 2], point - chain.back())))
      chain.pop_back();
    chain.push_back(point);
  };
  for (const Vector& point : points) add(point, 2);
  const std::size_t lower = chain.size() + 1;
  for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
  chain.pop_back();
  return chain;
}

/// Whether the origin is nearer than `reach` to the hull; for 0, within it and not at its border.
bool is_near_origin(const std::vector<Vector>& corners, const Wide& reach) {
  const bool is_area = corners.size() > 2;
  bool is_inside = is_area, is_within = is_area;
  const Wide rr = reach * reach;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector &p = corners[k], &q = corners[(k + 1) % corners.size()];
    if (dot(p, p) < rr) return true;
    const Wide side = cross(p, q);
    is_inside = is_inside && Wide(0) < side;
    is_within = is_within && !(side < Wide(0));
    const Vector along = q - p;
    const Wide length = dot(along, along), at = Wide(0) - dot(p, along);
    if (Wide(0) < at && at < length && side * side < rr * length) return true;
  }
  return is_inside || (is_within && Wide(0) < reach);
}

/// The corners of a body, as far as it has some.
std::vector<Point> corners_of(const Body& body) {
  return body.corners ? *body.corners : std::vector<Point>{Point{}};
}

}  // namespace

// All is times d * e, where d and e are how long the two last. At u after the first common moment
// the bodies differ by P + V u. Discs and spheres meet if that is less than R somewhere: the square
// is least at an end, or at u = -(P V) / (V V), where it is (P P) - (P V)^2 / (V V). With polygons,
// all differences of a point of the one and a point of the other at all these moments are a convex
// polygon, the hull of those of corners at the ends; and the bodies meet if the origin is less than
// R from that, or, if there is no R, within.
bool do_meet(const Motion& a, const Motion& b) {
  const Int begin = std::max(a.begin, b.begin), end = std::min(a.end, b.end);
  if (begin > end) return false;
  const auto lasts = [](const Motion& m) { return m.from == m.to ? 1 : m.end - m.begin; };
  const Wide d = lasts(a), e = lasts(b), u = end - begin;
  const auto moved = [&](const Motion& m, std::size_t k) {
    return m.from == m.to ? Wide(0) : Wide(m.to[k] - m.from[k]) * Wide(begin - m.begin);
  };
  Vector p{0, 0, 0}, v{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = (Wide(a.from[k]) * d + moved(a, k)) * e - (Wide(b.from[k]) * e + moved(b, k)) * d;
    v[k] = Wide(a.to[k] - a.from[k]) * e - Wide(b.to[k] - b.from[k]) * d;
  }
  const Wide reach = Wide(a.body.radius + b.body.radius) * d * e;
  if (a.body.corners || b.body.corners) {
    std::vector<Vector> points;
    for (const Point& x : corners_of(a.body))
      for (const Point& y : corners_of(b.body))
        for (const Wide& time : {Wide(0), u}) {
          Vector point{0, 0, 0};
          for (std::size_t k = 0; k < 2; ++k)
            point[k] = p[k] + v[k] * time + Wide(x[k] - y[k]) * d * e;
          points.push_back(point);
        }
    return is_near_origin(hull(std::move(points)), reach);
  }
  const Wide pp = dot(p, p), pv = dot(p, v), vv = dot(v, v), rr = reach * reach;
  if (pp < rr || pp + pv * u * 2 + vv * u * u < rr) return true;
  const bool is_between = pv < Wide(0) && Wide(0) - pv < vv * u;
  return is_between && pp * vv - pv * pv < rr * vv;
}

}  // namespace quadrille_check
