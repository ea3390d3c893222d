// SPDX-License-Identifier: MIT
#include "quadrille/geometry/body_pair.hpp"

#include "ball_pair.hpp"
#include "exact/exact.hpp"
#include "exact/offset_search.hpp"
#include "pair_shape.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::geometry {
namespace {

constexpr Point kOrigin[] = {{0, 0}};

void require_valid(const Motion& a, const Motion& b) {
  QUADRILLE_REQUIRE(is_valid(a) && is_valid(b), "a motion is outside the supported range");
}

Length radius_of(const Body& body) {
  const auto* disc = std::get_if<Disc>(&body);
  if (!disc) return 0;
  QUADRILLE_REQUIRE(1 <= disc->radius && disc->radius <= kMaxLength, "radius out of range");
  return disc->radius;
}

// Whether no point of the parallelogram can be less than `reach` from the shape, by their bounding
// boxes alone.
bool boxes_apart(const Parallelogram& places, std::span<const Point> shape, Length reach) {
  Point low = shape[0];
  Point high = shape[0];
  for (const Point& p : shape) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  bool left = true, right = true, below = true, above = true;
  for (const Point& p : places.corners) {
    left = left && p.x <= low.x - reach;
    right = right && p.x >= high.x + reach;
    below = below && p.y <= low.y - reach;
    above = above && p.y >= high.y + reach;
  }
  return left || right || below || above;
}

// Whether the line normal to `axis` somewhere has the two sets on different sides; it may touch
// them.
bool separates(const Point& axis, const Parallelogram& places, std::span<const Point> shape) {
  // Coordinates along the normal of the axis.
  Wide shape_low = cross(axis, shape[0]), shape_high = shape_low;
  for (const Point& p : shape.subspan(1)) {
    shape_low = std::min(shape_low, cross(axis, p));
    shape_high = std::max(shape_high, cross(axis, p));
  }
  Wide places_low = cross(axis, places.corners[0]), places_high = places_low;
  for (const Point& p : places.corners) {
    places_low = std::min(places_low, cross(axis, p));
    places_high = std::max(places_high, cross(axis, p));
  }
  return places_high <= shape_low || shape_high <= places_low;
}

// Exact. If two convex polygons, one of which may be a segment or a point, do not overlap, the
// direction of one of their sides separates them. A point and a point never overlap here.
bool insides_meet(const Parallelogram& places, std::span<const Point> shape) {
  bool any_axis = false;
  const auto separated = [&](const Point& axis) {
    if (axis == Point{}) return false;
    any_axis = true;
    return separates(axis, places, shape);
  };
  if (separated(places.corners[1] - places.corners[0])) return false;
  if (separated(places.corners[3] - places.corners[0])) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (separated(shape[(i + 1) % shape.size()] - shape[i])) return false;
  return any_axis;
}

double sides_distance(const Parallelogram& places, std::span<const Point> shape) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec from = to_vec(places.corners[i]);
    const Vec to = to_vec(places.corners[(i + 1) % 4]);
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Vec corner = to_vec(shape[k]);
      least = std::min(least, distance(corner, from, to));
      if (shape.size() > 1)
        least = std::min(least, distance(from, corner, to_vec(shape[(k + 1) % shape.size()])));
    }
  }
  return least;
}

}  // namespace

BodyPair::BodyPair(const Body& a, const Body& b) : reach_(radius_of(a) + radius_of(b)) {
  if (!std::holds_alternative<Disc>(a) || !std::holds_alternative<Disc>(b))
    shape_ = std::make_shared<const Shape>(a, b, reach_);
}

BodyPair BodyPair::swapped() const { return shape_ ? BodyPair(shape_->b(), shape_->a()) : *this; }

std::span<const Point> BodyPair::corners() const {
  return shape_ ? std::span<const Point>(shape_->corners()) : std::span<const Point>(kOrigin);
}

Length BodyPair::size() const { return shape_ ? shape_->size() : reach_; }

bool BodyPair::is_in_space(const Motion& a, const Motion& b) const {
  if (is_level(a, b)) return false;
  QUADRILLE_REQUIRE(!shape_, "a polygon stays at one height");
  return true;
}

bool BodyPair::collide_unchecked(const Motion& a, const Motion& b, Ticks offset) const {
  const std::optional<Window> window = common_window(a, b, offset);
  if (!window) return false;
  if (is_in_space(a, b)) return balls::meet(a, b, offset, *window, reach_);
  const RelativePath path = relative_path(a, b, offset, *window, size());
  if (shape_) {
    if (const int verdict = shape_->filter(path)) return verdict > 0;
  } else {
    const double apart = distance(Vec{}, path.begin, path.end);
    const double reach = static_cast<double>(reach_.value());
    if (apart < reach - path.error) return true;
    if (apart >= reach + path.error) return false;
  }
  return exact::meet(a, b, offset, *window, corners(), reach_);
}

bool BodyPair::collide(const Motion& a, const Motion& b, Ticks offset) const {
  require_valid(a, b);
  return collide_unchecked(a, b, offset);
}

bool BodyPair::can_meet(const Motion& a, const Motion& b) const {
  require_valid(a, b);
  const bool has_parts = a.is_part() || b.is_part();
  if (is_in_space(a, b) || (has_parts && !shape_)) return balls::can_meet(a, b, reach_);
  const Parallelogram places = relative_places(a, b);
  if (boxes_apart(places, corners(), reach_)) return false;
  if (insides_meet(places, corners())) return true;
  if (reach_ == 0) return false;
  const double error = error_bound(a, b, size());
  const double apart = sides_distance(places, corners());
  const double reach = static_cast<double>(reach_.value());
  if (apart < reach - error) return true;
  if (apart >= reach + error) return false;
  return exact::sides_within(places, corners(), reach_);
}

std::optional<TickInterval> BodyPair::unsafe_offsets(const Motion& a, const Motion& b) const {
  require_valid(a, b);
  const bool in_space = is_in_space(a, b);
  if (in_space ? balls::boxes_apart(a, b, reach_)
               : boxes_apart(relative_places(a, b), corners(), reach_))
    return std::nullopt;
  RealInterval likely;
  if (in_space)
    likely = balls::likely_offsets(a, b, reach_);
  else if (shape_)
    likely = shape_->likely_offsets(a, b);
  else
    include_disc(a, b, Vec{}, static_cast<double>(reach_.value()), likely);

  const Ticks least = -b.duration;
  const Ticks most = a.duration;
  const auto unsafe = [&](Ticks offset) { return collide_unchecked(a, b, offset); };
  const auto to_ticks = [&](double value) {  // Clamps; the limits are exact in doubles.
    return Ticks(static_cast<std::int64_t>(
        std::clamp(value, static_cast<double>(least.value()), static_cast<double>(most.value()))));
  };
  Ticks low = 0;
  Ticks high = 0;
  std::optional<Ticks> seed;
  if (!likely.empty()) {
    low = to_ticks(std::ceil(likely.lo));
    high = to_ticks(std::floor(likely.hi));
    for (const Ticks candidate : {low, high, low + (high - low) / 2}) {
      if (!unsafe(candidate)) continue;
      seed = candidate;
      break;
    }
  }
  if (!seed) {
    // The closed form found nothing, or a run so short that rounding hides it.
    if (!can_meet(a, b)) return std::nullopt;
    seed =
        in_space ? balls::find_meeting(a, b, reach_) : exact::find_meeting(a, b, corners(), reach_);
    if (!seed) return std::nullopt;
    low = high = *seed;
  }
  const Ticks hi = last_true(std::max(high, *seed), *seed, most, unsafe);
  const auto unsafe_mirrored = [&](Ticks offset) { return unsafe(-offset); };
  const Ticks lo = -last_true(std::max(-low, -*seed), -*seed, -least, unsafe_mirrored);
  return TickInterval::closed(lo, hi);
}

// A stander present during [arrive, duration], arrive >= 0, is a rest of that duration at the
// offset `arrive`, which collides iff the contact reaches beyond `arrive`; one present during [0,
// leave] is in contact while both are there iff a rest that starts leave - duration early is. So
// the run of unsafe offsets tells both ends of the contact.
std::optional<TickInterval> BodyPair::contact_window(const Motion& a, const Place& place) const {
  const std::optional<TickInterval> run = unsafe_offsets(a, rest(place, a.duration));
  if (!run) return std::nullopt;
  return TickInterval{a.duration + run->first() - 1, run->end};
}

bool BodyPair::overlap(const Place& place_a, const Place& place_b) const {
  return collide(rest(place_a, 0), rest(place_b, 0), 0);
}

std::optional<Gap> BodyPair::gap(const Motion& a, const Motion& b, Ticks offset) const {
  require_valid(a, b);
  const std::optional<Window> window = common_window(a, b, offset);
  if (!window) return std::nullopt;
  if (collide_unchecked(a, b, offset)) return Gap{};
  if (is_in_space(a, b)) return balls::gap(a, b, offset, *window, reach_);
  const RelativePath path = relative_path(a, b, offset, *window, size());
  const double apart = (shape_ ? shape_->distance(path) : distance(Vec{}, path.begin, path.end)) -
                       static_cast<double>(reach_.value());
  if (apart <= path.error && exact::touch(a, b, offset, *window, corners(), reach_)) return Gap{};
  return Gap{std::max(0.0, apart - path.error), apart + path.error};
}

}  // namespace quadrille::geometry
