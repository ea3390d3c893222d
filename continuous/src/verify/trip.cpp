// SPDX-License-Identifier: MIT
#include "verify/trip.hpp"

namespace quadrille::continuous {

std::string describe(const Piece& piece) {
  const std::string from = "vertex " + std::to_string(piece.start.index());
  if (piece.start == piece.goal) return "stands at " + from;
  return "moves from " + from + " to vertex " + std::to_string(piece.goal.index());
}

std::size_t Trip::size() const { return path_ != nullptr ? path_->size() : obstacle_->path.size(); }

Trip::At Trip::at(std::size_t k) const {
  if (path_ != nullptr) {
    const Stop& stop = (*path_)[k];
    return {stop.arrive, stop.depart, roadmap_->position(stop.vertex), stop.vertex,
            roadmap_->lane_place(stop.vertex)};
  }
  const MovingObstacle::Stop& stop = obstacle_->path[k];
  return {stop.arrive, stop.depart, stop.at, VertexId()};
}

std::optional<Piece> Trip::next() {
  const bool is_first = stop_ == 0;
  std::optional<Piece> piece = next_piece();
  if (piece) piece->is_first = is_first;
  return piece;
}

std::optional<Piece> Trip::next_piece() {
  while (stop_ < size()) {
    const At here = at(stop_);
    const bool is_last = stop_ + 1 == size();
    if (!has_stood_) {
      has_stood_ = true;
      const Ticks depart = is_last && !leaves_ ? horizon_ : here.depart;
      if (depart > here.arrive && here.on_lane != nullptr)
        return Piece{here.arrive,
                     depart,
                     roadmap_->position(here.on_lane->from),
                     roadmap_->position(here.on_lane->to),
                     here.vertex,
                     here.vertex,
                     here.on_lane->behind,
                     here.on_lane->whole,
                     true};
      if (depart > here.arrive)
        return Piece{here.arrive, depart, here.place, here.place, here.vertex, here.vertex};
    }
    has_stood_ = false;
    ++stop_;
    if (is_last) break;
    const At there = at(stop_);
    if (here.on_lane != nullptr)
      return Piece{here.depart,          there.arrive,       roadmap_->position(here.on_lane->from),
                   there.place,          here.vertex,        there.vertex,
                   here.on_lane->behind, here.on_lane->whole};
    return Piece{here.depart, there.arrive, here.place, there.place, here.vertex, there.vertex};
  }
  return std::nullopt;
}

}  // namespace quadrille::continuous
