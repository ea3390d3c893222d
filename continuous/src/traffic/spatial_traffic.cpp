// SPDX-License-Identifier: MIT
#include "traffic/spatial_traffic.hpp"

#include <algorithm>
#include <cstddef>

namespace quadrille::continuous {
namespace {

/// Before all others in the order of bans.
constexpr TickInterval kFirst{-kForever, -kForever};

/// What one look at a contact counts: most are in a hash table, some have to be computed.
constexpr std::int64_t kEffortOfContact = 4;

}  // namespace

SpatialTraffic::SpatialTraffic(Scene& scene)
    : scene_(scene),
      table_(scene.instance().roadmap()),
      grid_(scene.instance()),
      squares_(grid_.size()) {}

template <class Visit>
void SpatialTraffic::for_each_near(const Extent& box, const Visit& visit) {
  if (++query_ == 0) {  // all numbers have been used
    for (Passage& passage : passages_) passage.seen = 0;
    query_ = 1;
  }
  grid_.for_each(box, [&](std::size_t number) {
    const std::vector<std::uint32_t>& square = squares_[number];
    effort_ += static_cast<std::int64_t>(square.size());
    for (const std::uint32_t index : square) {
      Passage& passage = passages_[index];
      if (passage.seen == query_) continue;
      passage.seen = query_;
      if (entries_[passage.path].is_shown && box.overlaps(passage.box)) {
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
  Entry& entry = entries_[path];
  entry = {c, {}, true};
  for (const Step& step : steps) {
    if (free_passages_.empty()) {
      free_passages_.push_back(static_cast<std::uint32_t>(passages_.size()));
      passages_.emplace_back();
    }
    const std::uint32_t index = free_passages_.back();
    free_passages_.pop_back();
    passages_[index] = {step, grid_.box_of(c, step), path, 0};
    entry.passages.push_back(index);
    grid_.for_each(passages_[index].box, [&](std::size_t square) {
      squares_[square].push_back(index);
      ++effort_;
    });
  }
  return path;
}

void SpatialTraffic::show(Handle path, bool on) { entries_[path].is_shown = on; }

void SpatialTraffic::take_out(Handle path) {
  for (const std::uint32_t index : entries_[path].passages) {
    grid_.for_each(passages_[index].box, [&](std::size_t number) {
      std::vector<std::uint32_t>& square = squares_[number];
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
  const Extent box = grid_.box_of(asking_, instance.roadmap().position(edge.from),
                                  instance.roadmap().position(edge.to));
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

// Nobody is in the way of what begins after the end of a step, nor, if that has none, changes
// anything after its begin.
Ticks SpatialTraffic::horizon() const {
  Ticks last = 0;
  for (const Ban& ban : scene_.standing_bans(asking_)) last = std::max(last, ban.last_change());
  for (const Entry& entry : entries_)
    for (const std::uint32_t index : entry.passages) {
      const Step& step = passages_[index].step;
      last = std::max(last, step.end < kForever ? step.end : step.begin);
    }
  return last;
}

void SpatialTraffic::list_stays(VertexId v, std::vector<TickInterval>& bans) {
  const Instance& instance = scene_.instance();
  list_standing(Ban::stay(v, kFirst), bans);
  const Point at = instance.roadmap().position(v);
  for_each_near(grid_.box_of(asking_, at, at), [&](const Passage& passage) {
    if (!passage.step.is_move) return;  // who came later collides on its way
    const ClassId other = entries_[passage.path].c;
    if (const auto& window = scene_.contacts().window(other, passage.step.edge, asking_, v))
      bans.push_back(window->shifted(passage.step.begin));
  });
}

}  // namespace quadrille::continuous
