// SPDX-License-Identifier: MIT
#include "primal/guide.hpp"

#include <algorithm>
#include <cstddef>

#include "quadrille/core/contract.hpp"
#include "quadrille/core/random.hpp"
#include "reservations/reservations.hpp"

namespace quadrille::discrete {
namespace {

constexpr int kRounds = 3;
/// Vertices that may be looked at for one path: kEffortPerTimestep for each timestep, and
/// kLeastEffort. Where more are needed the agent keeps the path it has.
constexpr std::int64_t kEffortPerTimestep = 50, kLeastEffort = 1000;

/// Makes the paths.
class Lanes {
 public:
  Lanes(const Instance& instance, const GoalDistances& distances, Timestep margin,
        std::uint32_t seed)
      : instance_(instance),
        distances_(distances),
        margin_(margin),
        random_(seed),
        paths_(instance.num_agents()),
        passes_(instance.graph().num_vertices()),
        rests_since_(instance.graph().num_vertices(), kForever),
        reached_(instance.graph().num_vertices()) {}

  void find(LimitMonitor& limits) {
    std::vector<AgentId> order;
    for (const AgentId i : instance_.agent_ids()) order.push_back(i);
    std::int64_t fewest = INT64_MAX;
    for (int round = 0; round < kRounds; ++round) {
      random_.shuffle_front(order, order.size());
      std::int64_t meetings = 0;
      for (const AgentId i : order) {
        if (limits.exhausted()) return;
        meetings += renew(i);
      }
      if (meetings == 0 || meetings >= fewest) return;
      fewest = meetings;
    }
  }

  [[nodiscard]] const Path& path(AgentId agent) const { return paths_[agent]; }
  [[nodiscard]] std::int64_t effort() const noexcept { return effort_; }

 private:
  struct Pass {  // Of some agent, at the vertex of the list that it is in.
    Timestep time;
    VertexId next;
  };
  struct Label {
    VertexId vertex, parent;
    Timestep time;
    std::int64_t meetings;
  };
  struct Reached {
    std::uint32_t search = 0;
    VertexId parent;
  };

  /// Returns the meetings of the new path. A path without any stays.
  std::int64_t renew(AgentId agent) {
    Path& path = paths_[agent];
    const bool is_first = path.empty();
    if (!is_first) remove(path);
    std::int64_t meetings = is_first ? 1 : meetings_of(path);
    if (meetings > 0) meetings = search(agent);
    add(path);
    effort_ += static_cast<std::int64_t>(path.size()) / 4 + 1;
    return meetings;
  }

  void add(const Path& path) {
    for (std::size_t t = 0; t + 1 < path.size(); ++t) {
      auto& passes = passes_[path[t]];
      const Pass pass{static_cast<Timestep>(t), path[t + 1]};
      passes.insert(passes.begin() + static_cast<std::ptrdiff_t>(first_from(path[t], pass.time)),
                    pass);
    }
    rests_since_[path.back()] = static_cast<Timestep>(path.size() - 1);
  }

  void remove(const Path& path) {
    for (std::size_t t = 0; t + 1 < path.size(); ++t) {
      auto& passes = passes_[path[t]];
      const auto first = first_from(path[t], static_cast<Timestep>(t));
      passes.erase(std::find_if(passes.begin() + static_cast<std::ptrdiff_t>(first), passes.end(),
                                [&](const Pass& pass) { return pass.next == path[t + 1]; }));
    }
    rests_since_[path.back()] = kForever;
  }

  [[nodiscard]] std::int64_t meetings_of_move(VertexId from, VertexId to, Timestep arrival) const {
    std::int64_t count = rests_since_[to] <= arrival ? 1 : 0;
    const auto& passes = passes_[to];
    for (std::size_t k = first_from(to, arrival - 1); k < passes.size(); ++k) {
      if (passes[k].time > arrival) break;
      if (passes[k].time == arrival || passes[k].next == from) ++count;
    }
    return count;
  }

  /// Those who come later are in the way of who rests there.
  [[nodiscard]] std::int64_t passes_after(VertexId goal, Timestep arrival) const {
    return static_cast<std::int64_t>(passes_[goal].size() - first_from(goal, arrival + 1));
  }

  /// The first pass at that time or later.
  [[nodiscard]] std::size_t first_from(VertexId v, Timestep time) const {
    const auto& passes = passes_[v];
    return static_cast<std::size_t>(
        std::partition_point(passes.begin(), passes.end(),
                             [&](const Pass& pass) { return pass.time < time; }) -
        passes.begin());
  }

  /// Best first: fewest meetings, then least detour, then the label made last, which is nearest to
  /// the goal as a rule. Neither gets less along a path, so a bucket is not filled again once it
  /// was left.
  std::int64_t search(AgentId agent) {
    const auto row = distances_.row(agent);
    const VertexId start = instance_.agents()[agent].start, goal = instance_.agents()[agent].goal();
    const Timestep free = row[start];
    const auto bucket_of = [&](const Label& label) {
      return static_cast<std::size_t>(label.meetings * (margin_ + 1) + label.time +
                                      row[label.vertex] - free);
    };
    ++search_;
    for (auto& bucket : buckets_) bucket.clear();
    const std::int64_t enough =
        std::min(effort_ + kEffortPerTimestep * free + kLeastEffort, Guide::kMostEffort);
    push({start, start, 0, 0}, 0);
    for (std::size_t k = 0; k < buckets_.size(); ++k) {
      while (!buckets_[k].empty()) {
        const Label label = buckets_[k].back();
        buckets_[k].pop_back();
        if (reached_[label.vertex].search == search_) continue;
        reached_[label.vertex] = {search_, label.parent};
        if (label.vertex == goal) {
          trace(agent);
          return label.meetings;
        }
        if (++effort_ > enough) return keep(agent);
        for (const VertexId to : instance_.graph().neighbours(label.vertex)) {
          if (reached_[to].search == search_ || row[to] == kUnreachable ||
              label.time + 1 + row[to] > free + margin_)
            continue;
          Label next{to, label.vertex, label.time + 1,
                     label.meetings + meetings_of_move(label.vertex, to, label.time + 1)};
          if (to == goal) next.meetings += passes_after(goal, next.time);
          push(next, bucket_of(next));
        }
      }
    }
    return keep(agent);
  }

  void push(const Label& label, std::size_t bucket) {
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(label);
  }

  void trace(AgentId agent) {
    const VertexId start = instance_.agents()[agent].start, goal = instance_.agents()[agent].goal();
    Path& path = paths_[agent];
    path.clear();
    for (VertexId v = goal; v != start; v = reached_[v].parent) path.push_back(v);
    path.push_back(start);
    std::reverse(path.begin(), path.end());
  }

  /// The search took too long.
  std::int64_t keep(AgentId agent) {
    Path& path = paths_[agent];
    if (path.empty()) {
      const auto row = distances_.row(agent);
      path.push_back(instance_.agents()[agent].start);
      while (row[path.back()] > 0) {
        const auto near = instance_.graph().neighbours(path.back());
        path.push_back(*std::find_if(near.begin(), near.end(),
                                     [&](VertexId v) { return row[v] == row[path.back()] - 1; }));
      }
    }
    return meetings_of(path);
  }

  [[nodiscard]] std::int64_t meetings_of(const Path& path) const {
    const auto arrival = static_cast<Timestep>(path.size() - 1);
    std::int64_t meetings = passes_after(path.back(), arrival);
    for (Timestep t = 0; t < arrival; ++t)
      meetings += meetings_of_move(position(path, t), position(path, t + 1), t + 1);
    return meetings;
  }

  const Instance& instance_;
  const GoalDistances& distances_;
  const Timestep margin_;
  Random random_;
  IdVector<AgentId, Path> paths_;
  IdVector<VertexId, std::vector<Pass>> passes_;  // In order of time.
  IdVector<VertexId, Timestep> rests_since_;      // kForever: nobody's goal, or not yet.
  IdVector<VertexId, Reached> reached_;
  std::uint32_t search_ = 0;
  std::vector<std::vector<Label>> buckets_;
  std::int64_t effort_ = 0;
};

}  // namespace

Guide::Guide(const Instance& instance, const GoalDistances& distances, Timestep margin,
             std::uint32_t seed, LimitMonitor& limits)
    : steps_(instance.num_agents()) {
  QUADRILLE_REQUIRE(margin >= 0, "paths are not shorter than the shortest");
  Lanes lanes(instance, distances, margin, seed);
  lanes.find(limits);
  effort_ = lanes.effort();
  for (const AgentId i : instance.agent_ids()) {
    const Path& path = lanes.path(i);
    for (std::size_t t = 0; t + 1 < path.size(); ++t) steps_[i].push_back({path[t], path[t + 1]});
    std::sort(steps_[i].begin(), steps_[i].end(),
              [](const Step& a, const Step& b) { return a.from < b.from; });
  }
}

std::optional<VertexId> Guide::next(AgentId agent, VertexId from) const {
  const std::vector<Step>& steps = steps_[agent];
  const auto step = std::partition_point(steps.begin(), steps.end(),
                                         [&](const Step& other) { return other.from < from; });
  if (step == steps.end() || step->from != from) return std::nullopt;
  return step->to;
}

}  // namespace quadrille::discrete
