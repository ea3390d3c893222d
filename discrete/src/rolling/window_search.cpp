// SPDX-License-Identifier: MIT
#include "rolling/window_search.hpp"

#include <algorithm>

namespace quadrille::discrete {

WindowSearch::WindowSearch(const Graph& graph, const Window& window, Random& random)
    : graph_(graph), window_(window), ties_(random) {}

void WindowSearch::begin() {
  seen_.resize(2 * graph_.num_vertices() * (static_cast<std::size_t>(window_.length()) + 1), 0);
  if (++search_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    search_ = 1;
  }
  labels_.clear();
  for (auto& bucket : buckets_) bucket.clear();
}

const WindowSearch::Found* WindowSearch::find(VertexId start, const Errand& errand,
                                              const GoalDistances::Row& distances, Timestep most,
                                              std::int64_t effort) {
  begin();
  errand_ = errand;
  distances_ = distances;
  most_ = most;
  const bool is_there = errand.goals == nullptr || errand.goals->contains(start);
  least_ = is_there ? 0 : distances[start];
  reach(start, 0, is_there ? 0 : -1, kNone);
  const std::int64_t enough = effort_ + effort;
  for (std::size_t at = 0; at < buckets_.size();) {
    if (buckets_[at].empty()) {
      ++at;
      continue;
    }
    const std::uint32_t label = buckets_[at].back();
    buckets_[at].pop_back();
    std::uint32_t& seen = seen_[state(labels_[label])];
    if (seen == search_) continue;
    seen = search_;
    if (labels_[label].time == window_.length())
      return finish(label, least_ + static_cast<Timestep>(at));
    if (effort_++ >= enough) return nullptr;
    expand(label);
  }
  return nullptr;
}

void WindowSearch::expand(std::uint32_t from) {
  const Label label = labels_[from];
  const auto go = [&](VertexId to) {
    if (!window_.is_free(label.vertex, to, label.time)) return;
    const bool arrives = label.arrival < 0 && errand_.goals->contains(to);
    reach(to, label.time + 1, arrives ? label.time + 1 : label.arrival, from);
  };
  const bool is_held =
      label.time < errand_.hold || (label.arrival >= 0 && errand_.goals != nullptr &&
                                    label.time < label.arrival + errand_.service);
  if (is_held) return go(label.vertex);
  const bool stays_first = label.arrival >= 0;
  if (!stays_first) go(label.vertex);
  // A random first neighbour makes a random path among many of the same cost.
  const auto near = graph_.neighbours(label.vertex);
  const std::size_t shift = ties_.draw(near.size());
  for (std::size_t k = shift; k < near.size(); ++k) go(near[k]);
  for (std::size_t k = 0; k < shift; ++k) go(near[k]);
  // Last in, first out.
  if (stays_first) go(label.vertex);
}

void WindowSearch::reach(VertexId vertex, Timestep time, Timestep arrival, std::uint32_t parent) {
  const Timestep left = arrival < 0 ? distances_[vertex] : 0;
  if (left == kUnreachable) return;
  const Timestep cost = arrival < 0 ? time + left : arrival;
  if (cost > most_) return;
  const Label label{vertex, time, arrival, parent};
  if (seen_[state(label)] == search_) return;
  const auto at = static_cast<std::size_t>(cost - least_);
  if (at >= buckets_.size()) buckets_.resize(at + 1);
  buckets_[at].push_back(static_cast<std::uint32_t>(labels_.size()));
  labels_.push_back(label);
}

const WindowSearch::Found* WindowSearch::finish(std::uint32_t last, Timestep cost) {
  found_.cost = cost;
  found_.arrival.reset();
  if (labels_[last].arrival >= 0 && errand_.goals != nullptr)
    found_.arrival = labels_[last].arrival;
  found_.path.resize(static_cast<std::size_t>(labels_[last].time) + 1);
  for (std::uint32_t at = last; at != kNone; at = labels_[at].parent)
    found_.path[static_cast<std::size_t>(labels_[at].time)] = labels_[at].vertex;
  return &found_;
}

}  // namespace quadrille::discrete
