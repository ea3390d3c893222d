// SPDX-License-Identifier: MIT
#include "read/instance.hpp"

#include <algorithm>

namespace quadrille_check {

Instance Instance::on_grid(int width, int height, const std::vector<bool>& passable) {
  Instance made;
  made.width_ = width;
  made.height_ = height;
  made.exists_ = passable;
  made.begins_.reserve(passable.size() + 1);
  made.begins_.push_back(0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int place = y * width + x;
      const auto join = [&](bool is_inside, int other) {
        if (is_inside && made.has(other)) made.neighbours_.push_back(other);
      };
      if (made.has(place)) {
        join(y > 0, place - width);
        join(x > 0, place - 1);
        join(x + 1 < width, place + 1);
        join(y + 1 < height, place + width);
      }
      made.begins_.push_back(made.neighbours_.size());
    }
  return made;
}

Instance Instance::on_graph(int num_vertices, std::vector<std::pair<int, int>> edges) {
  for (std::size_t k = edges.size(); k-- > 0;) {
    const auto [a, b] = edges[k];
    if (a < 0 || b < 0 || a >= num_vertices || b >= num_vertices || a == b)
      throw BadInput("an edge joins no two vertices");
    edges.emplace_back(b, a);
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
    throw BadInput("an edge is given twice");
  Instance made;
  made.exists_.assign(static_cast<std::size_t>(num_vertices), true);
  made.begins_.assign(static_cast<std::size_t>(num_vertices) + 1, edges.size());
  for (std::size_t k = edges.size(); k-- > 0;) {
    made.begins_[static_cast<std::size_t>(edges[k].first)] = k;
    made.neighbours_.push_back(0);
  }
  for (std::size_t k = 0; k < edges.size(); ++k) made.neighbours_[k] = edges[k].second;
  for (std::size_t v = static_cast<std::size_t>(num_vertices); v-- > 0;)
    made.begins_[v] = std::min(made.begins_[v], made.begins_[v + 1]);
  return made;
}

void Instance::add_agent(Agent agent) {
  if (!has(agent.start) || !has(agent.goal))
    throw BadInput("an agent's start or goal is no place where it can be");
  if (!starts_.insert(agent.start).second || !goals_.insert(agent.goal).second)
    throw BadInput("two agents have the same start or the same goal");
  agents_.push_back(agent);
}

std::span<const int> Instance::neighbours(int place) const {
  const auto at = static_cast<std::size_t>(place);
  return std::span(neighbours_).subspan(begins_[at], begins_[at + 1] - begins_[at]);
}

bool Instance::are_joined(int a, int b) const {
  const auto others = neighbours(a);
  return std::find(others.begin(), others.end(), b) != others.end();
}

int Instance::least_distance(int a, int b) const {
  if (!is_grid()) return 0;
  return std::abs(a % width_ - b % width_) + std::abs(a / width_ - b / width_);
}

std::vector<int> Instance::distances(int from, int without) const {
  std::vector<int> distance(exists_.size(), kFar);
  if (from == without) return distance;
  std::vector<int> queue{from};
  distance[static_cast<std::size_t>(from)] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head)
    for (const int next : neighbours(queue[head])) {
      int& known = distance[static_cast<std::size_t>(next)];
      if (next == without || known != kFar) continue;
      known = distance[static_cast<std::size_t>(queue[head])] + 1;
      queue.push_back(next);
    }
  return distance;
}

Distances::Distances(const Instance& instance)
    : instance_(instance),
      most_(std::max<std::size_t>(
          8, (std::size_t{1} << 26) / (static_cast<std::size_t>(instance.num_places()) + 1))) {}

Distances::Table Distances::from(int place, int without) {
  const Key key{place, without};
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  if (order_.size() >= most_) {
    known_.erase(order_.front());
    order_.pop_front();
  }
  order_.push_back(key);
  return known_[key] =
             std::make_shared<const std::vector<int>>(instance_.distances(place, without));
}

}  // namespace quadrille_check
