// SPDX-License-Identifier: MIT
#include "reservations/soft_path_planner.hpp"

#include <algorithm>

namespace quadrille::discrete {

SoftPathPlanner::SoftPathPlanner(const Instance& instance, const GoalDistances& distances,
                                 Random& random)
    : instance_(instance),
      distances_(distances),
      ties_(random),
      row_(distances.row(AgentId(0))),
      heads_(instance.graph().num_vertices()) {}

std::optional<SoftPathPlanner::Result> SoftPathPlanner::find(AgentId agent,
                                                             const SoftReservations& reservations,
                                                             Timestep latest, std::int64_t most,
                                                             std::int64_t effort,
                                                             LimitMonitor& limits) {
  const std::int64_t enough = effort_ + effort;
  begin(agent, reservations, latest, most);
  while (const auto label = next()) {
    if (labels_[*label].piece == kAtRest)
      // The first rest is kept of those with as many meetings: the label before came from
      // elsewhere.
      return Result{path_to(labels_, labels_[*label].parent), labels_[*label].num_meetings};
    if (effort_ >= enough || ((++effort_ & 63) == 0 && limits.exhausted())) return std::nullopt;
    expand(*label);
  }
  return std::nullopt;
}

void SoftPathPlanner::begin(AgentId agent, const SoftReservations& reservations, Timestep latest,
                            std::int64_t most) {
  row_ = distances_.row(agent);
  reservations_ = &reservations;
  latest_ = latest;
  most_ = most;
  const VertexId start = instance_.agents()[agent].start;
  goals_ = &instance_.agents()[agent].goals;
  ++search_;
  labels_.clear();
  for (std::size_t k = 0; k < num_levels_; ++k) {
    Level& level = levels_[k];
    for (std::size_t i = level.at; i < level.end; ++i) level.buckets[i].clear();
    level.at = level.end = 0;
  }
  level_ = num_levels_ = 0;
  earliest_ = row_[start];
  const auto pieces = reservations.pieces(start);
  add({start, 0, 0, SoftReservations::end_of(pieces, 0), pieces.front().present, kNoLabel, kNoLabel,
       false},
      earliest_);
}

/// The label to expand next.
std::optional<SoftPathPlanner::LabelIndex> SoftPathPlanner::next() {
  for (; level_ < num_levels_; ++level_) {
    Level& level = levels_[level_];
    for (; level.at < level.end; ++level.at) {
      auto& bucket = level.buckets[level.at];
      while (!bucket.empty()) {
        // Last in, first out: among equals the one that is nearest to the goal, as a rule.
        const LabelIndex label = bucket.back();
        bucket.pop_back();
        if (!labels_[label].is_outdated) return label;
      }
    }
  }
  return std::nullopt;
}

void SoftPathPlanner::expand(LabelIndex from) {
  const VertexId v = labels_[from].vertex;
  if (goals_->contains(v)) rest(from);
  wait(from);
  const auto near = instance_.graph().neighbours(v);
  // A random first neighbour makes a random path among many that are as good.
  const std::size_t shift = ties_.draw(near.size());
  for (std::size_t k = shift; k < near.size(); ++k) reach(from, near[k]);
  for (std::size_t k = 0; k < shift; ++k) reach(from, near[k]);
}

/// Stays while others come or go.
void SoftPathPlanner::wait(LabelIndex from) {
  Label label = labels_[from];
  if (label.piece_end == kForever) return;
  const auto pieces = reservations_->pieces(label.vertex);
  ++label.piece;
  label.time = pieces[label.piece].begin;
  label.piece_end = SoftReservations::end_of(pieces, label.piece);
  label.num_meetings += pieces[label.piece].begins;
  label.parent = from;
  add(label, row_[label.vertex]);
}

/// Adds the arrivals in all pieces of a neighbour that overlap the rest of the label's piece.
void SoftPathPlanner::reach(LabelIndex from, VertexId to) {
  const Label label = labels_[from];
  const Timestep distance = row_[to];
  if (distance > latest_) return;
  const Timestep first = label.time + 1;
  const Timestep last = std::min(label.piece_end, latest_ - distance - 1) + 1;
  if (first > last) return;
  const auto pieces = reservations_->pieces(to);
  for (std::size_t k = SoftReservations::piece_at(pieces, first);
       k < pieces.size() && pieces[k].begin <= last; ++k) {
    const Timestep arrival = std::max(first, pieces[k].begin);
    std::uint32_t met = pieces[k].present;
    // Whoever leaves for the label's vertex when the agent comes swaps with it. The label's piece
    // ends then, so waiting in it does not help.
    if (arrival == pieces[k].begin && pieces[k].ends > 0 && label.piece_end == arrival - 1)
      met += reservations_->swaps(label.vertex, to, arrival);
    add({to, static_cast<std::uint32_t>(k), arrival, SoftReservations::end_of(pieces, k),
         label.num_meetings + met, from, kNoLabel, false},
        distance);
  }
}

/// Stays in a goal for ever, and meets all who are still to come.
void SoftPathPlanner::rest(LabelIndex from) {
  Label label = labels_[from];
  const auto stays = reservations_->stays(label.vertex);
  const auto later = std::partition_point(
      stays.begin(), stays.end(), [&](const Stay& stay) { return stay.begin <= label.piece_end; });
  label.num_meetings += static_cast<std::uint32_t>(stays.end() - later);
  label.piece = kAtRest;
  label.parent = from;
  add(label, row_[label.vertex]);
}

void SoftPathPlanner::add(const Label& label, Timestep distance) {
  if (label.num_meetings > most_ || distance > latest_ || label.time > latest_ - distance) return;
  Head& head = heads_[label.vertex];
  if (head.search != search_) head = {search_, kNoLabel};
  for (LabelIndex other = head.first; other != kNoLabel; other = labels_[other].next_here) {
    Label& known = labels_[other];
    if (known.piece != label.piece || known.is_outdated) continue;
    if (known.num_meetings <= label.num_meetings && known.time <= label.time) return;
    if (known.num_meetings >= label.num_meetings && known.time >= label.time)
      known.is_outdated = true;
  }
  const auto index = static_cast<LabelIndex>(labels_.size());
  labels_.push_back(label);
  labels_.back().next_here = head.first;
  labels_.back().is_outdated = false;
  head.first = index;
  if (label.num_meetings >= num_levels_) {
    num_levels_ = label.num_meetings + 1;
    if (levels_.size() < num_levels_) levels_.resize(num_levels_);
  }
  Level& level = levels_[label.num_meetings];
  const auto at = static_cast<std::size_t>(label.time + distance - earliest_);
  if (at >= level.end) {
    level.end = at + 1;
    if (level.buckets.size() < level.end) level.buckets.resize(level.end);
  }
  level.buckets[at].push_back(index);
}

}  // namespace quadrille::discrete
