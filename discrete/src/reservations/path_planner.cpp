// SPDX-License-Identifier: MIT
#include "reservations/path_planner.hpp"

#include <algorithm>

namespace quadrille::discrete {

PathPlanner::PathPlanner(const Instance& instance, const GoalDistances& distances, Random& random)
    : instance_(instance),
      distances_(distances),
      ties_(random),
      row_(distances.row(AgentId(0))),
      heads_(instance.graph().num_vertices()) {}

std::optional<Path> PathPlanner::find(AgentId agent, const Reservations& reservations,
                                      Timestep latest, std::int64_t effort, LimitMonitor& limits) {
  const std::int64_t enough = effort_ + effort;
  if (!begin(agent, reservations, latest)) return std::nullopt;
  for (std::size_t at = 0; at < num_buckets_;) {
    auto& bucket = buckets_[at];
    if (bucket.empty()) {
      ++at;
      continue;
    }
    // Last in, first out: among equals the one that is nearest to the goal, as a rule.
    const LabelIndex label = bucket.back();
    bucket.pop_back();
    if (labels_[label].outdated) continue;
    if (labels_[label].is_end) return path_to(labels_, label);
    if (effort_ >= enough || ((++effort_ & 63) == 0 && limits.exhausted())) return std::nullopt;
    expand(label);
  }
  return std::nullopt;
}

/// False when there can be no path.
bool PathPlanner::begin(AgentId agent, const Reservations& reservations, Timestep latest) {
  row_ = distances_.row(agent);
  reservations_ = &reservations;
  latest_ = latest;
  const VertexId start = instance_.agents()[agent].start;
  goals_ = &instance_.agents()[agent].goals;
  ++search_;
  labels_.clear();
  for (std::size_t k = 0; k < num_buckets_; ++k) buckets_[k].clear();
  num_buckets_ = 0;
  // The agent can only stay in a goal once all others have passed it for the last time.
  Timestep earliest_rest = kForever;
  for (const VertexId goal : goals_->vertices()) {
    const auto passing = reservations.stays(goal);
    const Timestep price = distances_.price(goal);
    if (passing.empty())
      earliest_rest = std::min(earliest_rest, price);
    else if (passing.back().end != kForever)
      earliest_rest = std::min(earliest_rest, passing.back().end + 1 + price);
  }
  if (earliest_rest == kForever) return false;
  earliest_ = std::max(row_[start], earliest_rest);
  if (earliest_ > latest_) return false;
  const auto stays = reservations.stays(start);
  add(start, 0, 0, stays.empty() ? kForever : stays.front().begin - 1, kNoLabel, row_[start]);
  return true;
}

void PathPlanner::expand(LabelIndex from) {
  const Label& label = labels_[from];
  Origin origin{label.vertex, from, label.time + 1, label.gap_end, label.vertex};
  if (label.parent != kNoLabel) {
    const Label& parent = labels_[label.parent];
    if (parent.gap_end >= origin.first) {
      origin.back = parent.vertex;
      origin.back_gap = parent.gap;
      origin.back_gap_end = parent.gap_end;
    }
  }
  const auto near = instance_.graph().neighbours(origin.vertex);
  // A random first neighbour makes a random path among many of the same length.
  const std::size_t shift = ties_.draw(near.size());
  for (std::size_t k = shift; k < near.size(); ++k) reach(origin, near[k]);
  for (std::size_t k = 0; k < shift; ++k) reach(origin, near[k]);
}

/// Adds the arrivals in all gaps of a neighbour that overlap the rest of the label's gap.
void PathPlanner::reach(const Origin& origin, VertexId to) {
  const Timestep distance = row_[to];
  const Timestep first = origin.first;
  const Timestep last = std::min(origin.gap_end, latest_ - distance - 1) + 1;
  if (first > last) return;
  const auto stays = reservations_->stays(to);
  std::size_t gap = 0;
  if (origin.back == to) {
    // Where it comes from, it was earlier; only the gaps after that one are left.
    if (origin.back_gap_end >= last) return;
    gap = origin.back_gap + 1;
  } else {
    gap = reservations_->first_ending_from(to, first);
  }
  for (; gap <= stays.size(); ++gap) {
    const Stay* const before = gap == 0 ? nullptr : &stays[gap - 1];
    if (before != nullptr && before->end == kForever) return;
    const Timestep begin = before == nullptr ? 0 : before->end + 1;
    const Timestep end = gap == stays.size() ? kForever : stays[gap].begin - 1;
    const Timestep arrival = std::max(first, begin);
    if (arrival > last) return;
    if (arrival > end) continue;
    // Whoever leaves for the label's vertex when the agent comes would swap with it. The label's
    // gap ends then, so waiting does not help.
    if (before != nullptr && arrival == begin && before->next == origin.vertex) continue;
    add(to, static_cast<std::uint32_t>(gap), arrival, end, origin.from, distance);
  }
}

void PathPlanner::add(VertexId v, std::uint32_t gap, Timestep time, Timestep gap_end,
                      LabelIndex parent, Timestep distance) {
  Head& head = heads_[v];
  if (head.search != search_) head = {search_, kNoLabel};
  for (LabelIndex other = head.first; other != kNoLabel; other = labels_[other].next_here) {
    Label& label = labels_[other];
    if (label.gap != gap || label.outdated) continue;
    if (label.time <= time) return;
    label.outdated = true;
    break;
  }
  const bool may_end = gap_end == kForever && goals_->contains(v);
  const Timestep price = may_end ? distances_.price(v) : 0;
  // Where a cheaper goal is near it may go on; else it ends here.
  const bool must_end = may_end && price == distance;
  const LabelIndex next_here = head.first;
  head.first = static_cast<LabelIndex>(labels_.size());
  put({v, gap, time, gap_end, parent, next_here, false, must_end}, time + distance);
  if (may_end && !must_end && time + price <= latest_)
    put({v, gap, time, gap_end, parent, kNoLabel, false, true}, time + price);
}

void PathPlanner::put(const Label& label, Timestep estimate) {
  const auto index = static_cast<LabelIndex>(labels_.size());
  labels_.push_back(label);
  estimate = std::max(estimate, earliest_);
  const auto at = static_cast<std::size_t>(estimate - earliest_);
  if (at >= num_buckets_) {
    num_buckets_ = at + 1;
    if (buckets_.size() < num_buckets_) buckets_.resize(num_buckets_);
  }
  buckets_[at].push_back(index);
}

}  // namespace quadrille::discrete
