// SPDX-License-Identifier: MIT
#include "primal/local_guide.hpp"

#include <algorithm>
#include <bit>

#include "model/trace.hpp"
#include "quadrille/core/contract.hpp"

namespace quadrille::discrete {

std::size_t LocalGuide::num_bytes(const Instance& instance) {
  const std::size_t vertices = instance.graph().num_vertices(),
                    edges = 2 * instance.graph().num_edges();
  return instance.num_agents() * kSize * sizeof(VertexId) +
         vertices * kSize * (sizeof(Count) + sizeof(std::uint32_t)) +
         edges * (kSize * sizeof(Count) + sizeof(std::uint32_t));
}

LocalGuide::LocalGuide(const Instance& instance, const GoalDistances& distances, Random& random)
    : instance_(instance),
      graph_(instance.graph()),
      distances_(distances),
      ties_(random),
      paths_(instance.num_agents() * kSize),
      is_counted_(instance.num_agents(), 0),
      present_(graph_.num_vertices() * kSize, 0),
      coming_(2 * graph_.num_edges() * kSize, 0),
      closed_in_(graph_.num_vertices() * kSize, 0),
      buckets_(kNumBuckets, kNoLabel),
      filled_(kNumBuckets / 64 + 1, 0) {
  QUADRILLE_REQUIRE(instance.num_agents() > 0, "there is somebody to guide");
  std::uint32_t num_edges = 0;
  for (const VertexId v : IdRange<VertexId>(graph_.num_vertices())) {
    first_edge_.push_back(num_edges);
    num_edges += static_cast<std::uint32_t>(graph_.neighbours(v).size());
  }
  reverse_.reserve(num_edges);
  for (const VertexId v : IdRange<VertexId>(graph_.num_vertices()))
    for (const VertexId to : graph_.neighbours(v))
      reverse_.push_back(static_cast<std::uint32_t>(edge(to, v)));
}

std::size_t LocalGuide::edge(VertexId from, VertexId to) const {
  const auto near = graph_.neighbours(from);
  return first_edge_[from] +
         static_cast<std::size_t>(std::find(near.begin(), near.end(), to) - near.begin());
}

std::optional<VertexId> LocalGuide::next(AgentId agent, VertexId from) const {
  const auto guide = path(agent);
  if (guide[0] != from) return std::nullopt;
  return guide[1];
}

void LocalGuide::renew(std::span<const VertexId> configuration, std::span<const AgentId> order) {
  for (const AgentId agent : order) {
    const auto guide = own_path(agent);
    // What is left of a path that was not followed is worth nothing.
    is_counted_[agent.index()] = !is_first_ && guide[1] == configuration[agent.index()] ? 1 : 0;
    if (is_counted_[agent.index()] == 0) continue;
    std::copy(guide.begin() + 1, guide.end(), guide.begin());
    add(guide);
  }
  for (const AgentId agent : order) {
    const auto guide = own_path(agent);
    if (is_counted_[agent.index()] != 0) remove(guide);
    const VertexId here = configuration[agent.index()];
    if (here == instance_.agents()[agent].goal())
      std::fill(guide.begin(), guide.end(), here);
    else
      search(agent, here);
    add(guide);
  }
  for (const AgentId agent : order) remove(path(agent));
  is_first_ = false;
}

void LocalGuide::add(std::span<const VertexId> path) {
  for (std::size_t t = 1; t < kSize; ++t) {
    ++present_[at(path[t].index()) + t];
    if (path[t] != path[t - 1]) ++coming_[at(reverse_[edge(path[t - 1], path[t])]) + t];
  }
}

void LocalGuide::remove(std::span<const VertexId> path) {
  for (std::size_t t = 1; t < kSize; ++t) {
    --present_[at(path[t].index()) + t];
    if (path[t] != path[t - 1]) --coming_[at(reverse_[edge(path[t - 1], path[t])]) + t];
  }
}

/// A* over vertices and timesteps. Among labels that promise the same the one nearest to the goal
/// comes first. Otherwise agents put off meetings: who waits now does not get as far within the
/// window as where it would have to meet others, which looks as cheap at every timestep.
void LocalGuide::search(AgentId agent, VertexId start) {
  const auto distances = distances_.row(agent);
  const VertexId goal = instance_.agents()[agent].goal();
  if (++search_ == 0) {
    std::fill(closed_in_.begin(), closed_in_.end(), 0);
    search_ = 1;
  }
  labels_.clear();
  std::fill(buckets_.begin(), buckets_.end(), kNoLabel);
  std::fill(filled_.begin(), filled_.end(), 0);
  first_filled_ = 0;
  least_left_ = distances[start] - static_cast<Timestep>(kWindow);
  push({start, 0, 0, kNoLabel, kNoLabel}, distances[start]);
  while (const auto index = pop()) {
    const Label& label = labels_[*index];
    std::uint32_t& closed = closed_in_[at(label.vertex.index()) + label.time];
    if (closed == search_) continue;
    closed = search_;
    ++effort_;
    if (label.time == kWindow || label.vertex == goal) {
      trace(agent, *index);
      return;
    }
    expand(*index, distances);
  }
  QUADRILLE_REQUIRE(false, "who stays has a path");
}

void LocalGuide::push(const Label& label, Timestep left) {
  const auto way = static_cast<std::size_t>(left - least_left_);
  // Beyond what the path would cost without others: both grow along a path.
  const std::size_t extra = label.time + label.penalties + way - kWindow;
  if (extra > kMostExtra) return;
  const std::size_t bucket = extra * (2 * kWindow + 1) + way;
  labels_.push_back(label);
  labels_.back().next_in_bucket = buckets_[bucket];
  buckets_[bucket] = static_cast<LabelIndex>(labels_.size() - 1);
  filled_[bucket / 64] |= std::uint64_t{1} << (bucket % 64);
  first_filled_ = std::min(first_filled_, bucket / 64);
}

std::optional<LocalGuide::LabelIndex> LocalGuide::pop() {
  while (first_filled_ < filled_.size() && filled_[first_filled_] == 0) ++first_filled_;
  if (first_filled_ == filled_.size()) return std::nullopt;
  std::uint64_t& word = filled_[first_filled_];
  const std::size_t bucket = 64 * first_filled_ + static_cast<std::size_t>(std::countr_zero(word));
  const LabelIndex label = buckets_[bucket];
  buckets_[bucket] = labels_[label].next_in_bucket;
  if (buckets_[bucket] == kNoLabel) word &= word - 1;
  return label;
}

void LocalGuide::expand(LabelIndex from, const GoalDistances::Row& distances) {
  const Label label = labels_[from];
  const std::uint32_t time = label.time + 1;
  const auto reach = [&](VertexId to, bool meets) {
    push({to, time, label.penalties + (meets ? kPenalty : 0), from, kNoLabel}, distances[to]);
  };
  const std::size_t here = at(label.vertex.index()) + time;
  if (closed_in_[here] != search_) reach(label.vertex, present_[here] > 0);
  const auto near = graph_.neighbours(label.vertex);
  const auto to = [&](std::size_t k) {
    const std::size_t there = at(near[k].index()) + time;
    if (closed_in_[there] == search_) return;
    reach(near[k], present_[there] + coming_[at(first_edge_[label.vertex] + k) + time] > 0);
  };
  // A random first neighbour makes a random path among many that are as good.
  const std::size_t shift = ties_.draw(near.size());
  for (std::size_t k = shift; k < near.size(); ++k) to(k);
  for (std::size_t k = 0; k < shift; ++k) to(k);
}

/// Who gets to the goal stays there.
void LocalGuide::trace(AgentId agent, LabelIndex last) {
  const auto guide = own_path(agent);
  std::fill(guide.begin() + labels_[last].time, guide.end(), labels_[last].vertex);
  for (LabelIndex k = last; k != kNoLabel; k = labels_[k].parent)
    guide[labels_[k].time] = labels_[k].vertex;
}

}  // namespace quadrille::discrete
