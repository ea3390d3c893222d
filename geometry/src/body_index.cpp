// SPDX-License-Identifier: MIT
#include "quadrille/geometry/body_index.hpp"

// Boost's headers would warn of each other.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <algorithm>
// Whole: from Boost 1.77 on the index alone lacks what it needs of the rest.
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "quadrille/geometry/body_pair.hpp"

namespace quadrille::geometry {
namespace {

namespace index = boost::geometry::index;

// Coordinates are below 2^42, and so exact.
using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Corner>;

/// Around the way on which `place` is, with what is added at the least and at the most.
Box box_at(const Place& place, const Point& low, const Point& high) {
  const auto least = [&](Length Point::*at) {
    return static_cast<double>((std::min(place.from.*at, place.to.*at) + low.*at).value());
  };
  const auto most = [&](Length Point::*at) {
    return static_cast<double>((std::max(place.from.*at, place.to.*at) + high.*at).value());
  };
  return {{least(&Point::x), least(&Point::y), least(&Point::z)},
          {most(&Point::x), most(&Point::y), most(&Point::z)}};
}

Box box_of(const Body& body, const Place& place) {
  if (const Disc* const disc = std::get_if<Disc>(&body)) {
    const Length r = disc->radius;
    return box_at(place, {-r, -r, -r}, {r, r, r});
  }
  const std::vector<Point>& corners = std::get<ConvexPolygon>(body).vertices();
  Point low = corners.front(), high = corners.front();
  for (const Point& corner : corners) {
    low.x = std::min(low.x, corner.x);
    low.y = std::min(low.y, corner.y);
    high.x = std::max(high.x, corner.x);
    high.y = std::max(high.y, corner.y);
  }
  return box_at(place, low, high);
}

}  // namespace

class BodyIndex::Tree {
 public:
  struct Entry {
    std::size_t number;
    Body body;
    Place place;
  };

  void add(Entry entry) {
    boxes_.insert({box_of(entry.body, entry.place), entries_.size()});
    entries_.push_back(std::move(entry));
  }

  [[nodiscard]] std::optional<std::size_t> first_overlap(const Body& body,
                                                         const Place& place) const {
    std::optional<std::size_t> first;
    const auto near = index::intersects(box_of(body, place));
    for (auto at = boxes_.qbegin(near); at != boxes_.qend(); ++at) {
      const Entry& entry = entries_[at->second];
      if (first && *first <= entry.number) continue;
      if (bodies_overlap(entry.body, entry.place, body, place)) first = entry.number;
    }
    return first;
  }

 private:
  std::vector<Entry> entries_;
  index::rtree<std::pair<Box, std::size_t>, index::quadratic<16>> boxes_;
};

BodyIndex::BodyIndex() : tree_(std::make_unique<Tree>()) {}
BodyIndex::~BodyIndex() = default;
BodyIndex::BodyIndex(BodyIndex&&) noexcept = default;
BodyIndex& BodyIndex::operator=(BodyIndex&&) noexcept = default;

void BodyIndex::add(std::size_t number, const Body& body, const Place& place) {
  tree_->add({number, body, place});
}

std::optional<std::size_t> BodyIndex::first_overlap(const Body& body, const Place& place) const {
  return tree_->first_overlap(body, place);
}

}  // namespace quadrille::geometry
