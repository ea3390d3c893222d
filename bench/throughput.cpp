// SPDX-License-Identifier: MIT
// How many tasks a fleet on a grid does per timestep: our dispatcher, beside plain PIBT (Okumura et
// al., AIJ 2022; code of its own here, which shares nothing with ours). Whoever has arrived gets
// another goal, uniformly at random among the cells of the largest component.
//
// usage: quadrille_throughput_bench MAP robots steps [effort-ms window delays longest-pause]
// effort -1: plain PIBT. One line: tasks per timestep, the gaps of calls, CPU time of calls.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "quadrille/core/limits.hpp"
#include "quadrille/core/random.hpp"
#include "quadrille/discrete/movingai.hpp"
#include "quadrille/dispatch/grid_dispatcher.hpp"

using namespace quadrille;
using discrete::Graph;

namespace {

std::vector<VertexId> largest_component(const Graph& graph) {
  std::vector<VertexId> largest;
  std::vector<bool> is_seen(graph.num_vertices(), false);
  for (std::size_t s = 0; s < graph.num_vertices(); ++s) {
    if (is_seen[s]) continue;
    std::vector<VertexId> found{VertexId(s)};
    is_seen[s] = true;
    for (std::size_t k = 0; k < found.size(); ++k)
      for (const VertexId v : graph.neighbours(found[k])) {
        if (is_seen[v.index()]) continue;
        is_seen[v.index()] = true;
        found.push_back(v);
      }
    if (found.size() > largest.size()) largest = std::move(found);
  }
  return largest;
}

/// Without the swap operation, and with random ties; who has been on the way for longest comes
/// first.
class PlainPibt {
 public:
  PlainPibt(const Graph& graph, std::vector<VertexId> places, std::uint64_t seed)
      : graph_(graph),
        random_(seed),
        places_(std::move(places)),
        next_(places_.size()),
        waits_(places_.size(), 0),
        rows_(places_.size()),
        now_(graph.num_vertices(), kNobody),
        then_(graph.num_vertices(), kNobody) {}

  void send(std::size_t i, VertexId goal) {
    rows_[i] = discrete::distances_from(graph_, goal);
    waits_[i] = 0;
  }
  [[nodiscard]] VertexId place(std::size_t i) const { return places_[i]; }
  [[nodiscard]] Timestep distance(std::size_t i) const { return rows_[i][places_[i]]; }

  void step() {
    for (std::size_t i = 0; i < places_.size(); ++i) now_[places_[i].index()] = i;
    std::vector<std::size_t> order(places_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return waits_[a] != waits_[b] ? waits_[a] > waits_[b] : a < b;
    });
    decided_.assign(places_.size(), false);
    for (const std::size_t i : order)
      if (!decided_[i]) static_cast<void>(move(i, kNobody));
    for (std::size_t i = 0; i < places_.size(); ++i) now_[places_[i].index()] = kNobody;
    for (std::size_t i = 0; i < places_.size(); ++i) then_[next_[i].index()] = kNobody;
    places_ = next_;
    for (std::size_t& wait : waits_) ++wait;
  }

 private:
  static constexpr std::size_t kNobody = SIZE_MAX;

  bool move(std::size_t i, std::size_t pusher) {
    const auto near = graph_.neighbours(places_[i]);
    std::vector<VertexId> ways(near.begin(), near.end());
    ways.push_back(places_[i]);
    random_.shuffle_front(ways, ways.size());
    std::stable_sort(ways.begin(), ways.end(),
                     [&](VertexId a, VertexId b) { return rows_[i][a] < rows_[i][b]; });
    decided_[i] = true;
    for (const VertexId v : ways) {
      if (then_[v.index()] != kNobody) continue;
      if (pusher != kNobody && v == places_[pusher]) continue;
      const std::size_t other = now_[v.index()];
      then_[v.index()] = i;
      next_[i] = v;
      if (other != kNobody && !decided_[other] && !move(other, i)) continue;
      return true;
    }
    then_[places_[i].index()] = i;
    next_[i] = places_[i];
    return false;
  }

  const Graph& graph_;
  Random random_;
  std::vector<VertexId> places_, next_;
  std::vector<std::size_t> waits_;
  std::vector<IdVector<VertexId, Timestep>> rows_;
  std::vector<std::size_t> now_, then_;  // by vertex: who
  std::vector<bool> decided_;
};

struct Asked {
  std::size_t robots = 0;
  Timestep steps = 0;
  double effort_ms = 20;
  Timestep window = 20;
  double delays = 0;
  Timestep longest_pause = 3;
};

struct Row {
  std::size_t num_done = 0;
  std::vector<double> gaps, seconds;
};

double quantile(std::vector<double> numbers, double share) {
  if (numbers.empty()) return 0;
  std::sort(numbers.begin(), numbers.end());
  const double at = std::ceil(share * static_cast<double>(numbers.size())) - 1;
  return numbers[static_cast<std::size_t>(std::max(at, 0.0))];
}

Row run_pibt(const Graph& graph, const std::vector<VertexId>& cells, std::vector<VertexId> places,
             const Asked& asked, Random& random) {
  Row row;
  PlainPibt pibt(graph, places, 1);
  const auto send = [&](std::size_t i) {
    pibt.send(i, cells[static_cast<std::size_t>(random.below(cells.size()))]);
  };
  for (std::size_t i = 0; i < asked.robots; ++i) send(i);
  for (Timestep t = 0; t < asked.steps; ++t) {
    const double before_s = thread_cpu_seconds();
    for (std::size_t i = 0; i < asked.robots; ++i)
      for (; pibt.distance(i) == 0; ++row.num_done) send(i);
    pibt.step();
    row.seconds.push_back(thread_cpu_seconds() - before_s);
  }
  return row;
}

Row run_dispatcher(const std::shared_ptr<const Graph>& graph, const std::vector<VertexId>& cells,
                   const std::vector<VertexId>& places, const Asked& asked, Random& random) {
  Row row;
  dispatch::GridOptions options;
  options.effort = Effort::nanoseconds(static_cast<std::int64_t>(1e6 * asked.effort_ms));
  options.window = asked.window;
  auto dispatcher = dispatch::GridDispatcher::make(graph, places, options).value();
  std::vector<Timestep> paused_until(asked.robots, 0);
  for (Timestep t = 0; t < asked.steps; ++t) {
    for (std::size_t i = 0; i < asked.robots; ++i) {
      // Two at a time: the next one begins when the first is done.
      while (dispatcher.num_tasks(AgentId(i)) < 2)
        static_cast<void>(dispatcher.assign(
            AgentId(i), {cells[static_cast<std::size_t>(random.below(cells.size()))]}));
      if (paused_until[i] <= t && random.chance(asked.delays))
        paused_until[i] =
            t + 1 +
            static_cast<Timestep>(random.below(static_cast<std::uint64_t>(asked.longest_pause)));
    }
    std::vector<AgentId> held;
    for (std::size_t i = 0; i < asked.robots; ++i)
      if (paused_until[i] > t) held.emplace_back(i);
    const double before_s = thread_cpu_seconds();
    const dispatch::News news = dispatcher.tick(held);
    row.seconds.push_back(thread_cpu_seconds() - before_s);
    row.num_done += news.served.size();
    if (news.lower_bound > 0)
      row.gaps.push_back(100 * static_cast<double>(news.cost - news.lower_bound) /
                         static_cast<double>(news.lower_bound));
  }
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s MAP robots steps [effort-ms window delays longest-pause]\n",
                 argv[0]);
    return 64;
  }
  const auto map = discrete::read_map(argv[1]);
  if (!map) {
    std::fprintf(stderr, "%s\n", map.error().message.c_str());
    return 65;
  }
  const auto number = [&](int at, double otherwise) {
    return argc > at ? std::strtod(argv[at], nullptr) : otherwise;
  };
  Asked asked;
  asked.robots = static_cast<std::size_t>(number(2, 0));
  asked.steps = static_cast<Timestep>(number(3, 0));
  asked.effort_ms = number(4, asked.effort_ms);
  asked.window = static_cast<Timestep>(number(5, asked.window));
  asked.delays = number(6, asked.delays);
  asked.longest_pause = static_cast<Timestep>(number(7, asked.longest_pause));
  const auto graph =
      std::make_shared<const Graph>(Graph::grid(map->width, map->height, map->passable));
  const std::vector<VertexId> cells = largest_component(*graph);
  if (asked.robots < 1 || asked.robots > cells.size() || asked.steps < 1) {
    std::fprintf(stderr, "robots and steps: at least 1, and no more robots than cells\n");
    return 64;
  }
  Random random(1);
  std::vector<VertexId> places = cells;
  random.shuffle_front(places, asked.robots);
  places.resize(asked.robots);
  const Row row = asked.effort_ms < 0 ? run_pibt(*graph, cells, places, asked, random)
                                      : run_dispatcher(graph, cells, places, asked, random);
  double all_s = 0;
  for (const double one : row.seconds) all_s += one;
  std::printf(
      "%zu robots, %d timesteps, effort %g ms, window %d, delays %g: %.3f tasks per timestep; gap "
      "median %.2f %%; CPU ms per call: mean %.1f, 99.9 %% %.1f, longest %.1f\n",
      asked.robots, asked.steps, asked.effort_ms, asked.window, asked.delays,
      static_cast<double>(row.num_done) / asked.steps, quantile(row.gaps, 0.5),
      1e3 * all_s / asked.steps, 1e3 * quantile(row.seconds, 0.999),
      1e3 * quantile(row.seconds, 1));
  return 0;
}
