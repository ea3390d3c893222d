// SPDX-License-Identifier: MIT
#include "paths/spatial_traffic.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::continuous {
namespace {

/// Before all others in the order of bans.
constexpr TickInterval kFirst{-kForever, -kForever};

/// What one look at a contact counts: most are in a hash table, some have to be computed.
constexpr std::int64_t kEffortOfContact = 4;

bool overlap(const Point& low, const Point& high, const Point& other_low, const Point& other_high) {
  return low.x < other_high.x && other_low.x < high.x && low.y < other_high.y &&
         other_low.y < high.y && low.z < other_high.z && other_low.z < high.z;
}

}  // namespace

// About as many squares as vertices: an edge to a neighbour then covers few of them. Seen from
// above; boxes tell heights apart.
SpatialTraffic::SpatialTraffic(Scene& scene) : scene_(scene), table_(scene.instance().roadmap()) {
  const std::vector<Point>& positions = scene.instance().roadmap().positions();
  if (positions.empty()) return;
  Point low = positions.front(), high = low;
  for (const Point& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  origin_ = low;
  const std::int64_t width = (high.x - low.x).count(), height = (high.y - low.y).count();
  const auto per_side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(positions.size())));
  side_ = std::max(width, height) / std::max<std::int64_t>(per_side, 1) + 1;
  columns_ = width / side_ + 1;
  rows_ = height / side_ + 1;
  squares_.resize(static_cast<std::size_t>(columns_ * rows_));
}

SpatialTraffic::Box SpatialTraffic::box_of(const Point& p, const Point& q, Length reach) const {
  return {{std::min(p.x, q.x) - reach, std::min(p.y, q.y) - reach, std::min(p.z, q.z) - reach},
          {std::max(p.x, q.x) + reach, std::max(p.y, q.y) + reach, std::max(p.z, q.z) + reach}};
}

SpatialTraffic::Squares SpatialTraffic::squares_of(const Box& box) const {
  const auto clamped = [&](Length at, Length origin, std::int64_t count) {
    return std::clamp<std::int64_t>((at - origin).count() / side_, 0, count - 1);
  };
  return {clamped(box.low.x, origin_.x, columns_), clamped(box.high.x, origin_.x, columns_),
          clamped(box.low.y, origin_.y, rows_), clamped(box.high.y, origin_.y, rows_)};
}

template <class Visit>
void SpatialTraffic::for_each_square(const Box& box, const Visit& visit) {
  const Squares at = squares_of(box);
  for (std::int64_t row = at.bottom; row <= at.top; ++row)
    for (std::int64_t column = at.left; column <= at.right; ++column)
      visit(squares_[static_cast<std::size_t>(row * columns_ + column)]);
}

template <class Visit>
void SpatialTraffic::for_each_near(const Box& box, const Visit& visit) {
  if (++query_ == 0) {  // all numbers have been used
    for (Passage& passage : passages_) passage.seen = 0;
    query_ = 1;
  }
  for_each_square(box, [&](const std::vector<std::uint32_t>& square) {
    effort_ += static_cast<std::int64_t>(square.size());
    for (const std::uint32_t index : square) {
      Passage& passage = passages_[index];
      if (passage.seen == query_) continue;
      passage.seen = query_;
      if (entries_[passage.path].is_shown &&
          overlap(box.low, box.high, passage.box.low, passage.box.high)) {
        effort_ += kEffortOfContact;
        visit(passage);
      }
    }
  });
}

Traffic::Handle SpatialTraffic::put(ClassId c, const std::vector<Step>& steps) {
  scene_.limits().check();
  if (free_.empty()) {
    free_.push_back(static_cast<Handle>(entries_.size()));
    entries_.emplace_back();
  }
  const Handle path = free_.back();
  free_.pop_back();
  const Roadmap& roadmap = scene_.instance().roadmap();
  Entry& entry = entries_[path];
  entry = {c, {}, true};
  for (const Step& step : steps) {
    if (free_passages_.empty()) {
      free_passages_.push_back(static_cast<std::uint32_t>(passages_.size()));
      passages_.emplace_back();
    }
    const std::uint32_t index = free_passages_.back();
    free_passages_.pop_back();
    const Point from = roadmap.position(step.is_move ? roadmap.edge(step.edge).from : step.vertex);
    const Point to = step.is_move ? roadmap.position(roadmap.edge(step.edge).to) : from;
    passages_[index] = {step, box_of(from, to, scene_.instance().reach(c)), path, 0};
    entry.passages.push_back(index);
    for_each_square(passages_[index].box, [&](std::vector<std::uint32_t>& square) {
      square.push_back(index);
      ++effort_;
    });
  }
  return path;
}

void SpatialTraffic::show(Handle path, bool on) { entries_[path].is_shown = on; }

void SpatialTraffic::take_out(Handle path) {
  for (const std::uint32_t index : entries_[path].passages) {
    for_each_square(passages_[index].box, [&](std::vector<std::uint32_t>& square) {
      square.erase(std::find(square.begin(), square.end(), index));
    });
    free_passages_.push_back(index);
  }
  entries_[path] = {};
  free_.push_back(path);
}

void SpatialTraffic::clear() {
  for (std::vector<std::uint32_t>& square : squares_) square.clear();
  entries_.clear();
  free_.clear();
  passages_.clear();
  free_passages_.clear();
}

BanTable& SpatialTraffic::bans(ClassId c) {
  asking_ = c;
  table_.ask(*this);
  return table_;
}

void SpatialTraffic::list_standing(const Ban& least, std::vector<TickInterval>& bans) const {
  const std::vector<Ban>& standing = scene_.standing_bans(asking_);
  auto at = std::lower_bound(standing.begin(), standing.end(), least);
  for (; at != standing.end() && at->kind == least.kind && at->place == least.place; ++at)
    bans.push_back(at->when);
}

// As BansAround, seen from the place instead of from the path.
void SpatialTraffic::list_starts(EdgeId e, Ticks from, std::vector<TickInterval>& bans) {
  const Instance& instance = scene_.instance();
  list_standing(Ban::start(e, kFirst), bans);
  const Edge& edge = instance.roadmap().edge(e);
  const Box box = box_of(instance.roadmap().position(edge.from),
                         instance.roadmap().position(edge.to), instance.reach(asking_));
  for_each_near(box, [&](const Passage& passage) {
    const ClassId other = entries_[passage.path].c;
    const Step& step = passage.step;
    if (step.end < from) return;  // Nobody who starts after the end of a step collides with it.
    if (step.is_move) {
      if (const auto& offsets = scene_.contacts().offsets(other, step.edge, asking_, e))
        bans.push_back(starts_against(*offsets, step.begin));
    } else if (const auto& window = scene_.contacts().window(asking_, e, other, step.vertex)) {
      bans.push_back(starts_meeting(*window, step.begin, step.end));
    }
  });
}

void SpatialTraffic::list_stays(VertexId v, std::vector<TickInterval>& bans) {
  const Instance& instance = scene_.instance();
  list_standing(Ban::stay(v, kFirst), bans);
  const Point at = instance.roadmap().position(v);
  for_each_near(box_of(at, at, instance.reach(asking_)), [&](const Passage& passage) {
    if (!passage.step.is_move) return;  // who came later collides on its way
    const ClassId other = entries_[passage.path].c;
    if (const auto& window = scene_.contacts().window(other, passage.step.edge, asking_, v))
      bans.push_back(window->shifted(passage.step.begin));
  });
}

}  // namespace quadrille::continuous
