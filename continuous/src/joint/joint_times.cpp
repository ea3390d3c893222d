// SPDX-License-Identifier: MIT
#include "joint/joint_times.hpp"

#include <algorithm>
#include <utility>

#include "quadrille/core/contract.hpp"

namespace quadrille::continuous {
namespace {

/// time[to] >= time[from] + gap.
struct Gap {
  std::size_t from, to;
  Ticks gap;
};

std::vector<Gap> gaps_of(JointSpace& space, const std::vector<JointStep>& steps) {
  std::vector<Gap> gaps;
  std::vector<std::size_t> begin(space.size(), 0);  // by agent, of its last move
  std::vector<AgeLimit> ages;
  JointPlaces places = space.starts().value();
  for (std::size_t at = 0; at < steps.size(); ++at) {
    if (at > 0) gaps.push_back({at - 1, at, 0});
    space.list_limits(places, steps[at], ages);
    for (const AgeLimit& a : ages)
      gaps.push_back(a.is_least ? Gap{begin[a.agent], at, a.age} : Gap{at, begin[a.agent], -a.age});
    if (steps[at].begins) begin[steps[at].agent] = at;
    places = space.after(places, steps[at]);
  }
  return gaps;
}

/// `times`: when the events happen at the earliest, by the clock.
std::vector<Ticks> least_times(const std::vector<Gap>& gaps, std::vector<Ticks> times) {
  const std::size_t size = times.size();
  bool has_changed = true;
  for (std::size_t round = 0; has_changed; ++round) {
    QUADRILLE_REQUIRE(round <= size, "the events have times");
    has_changed = false;
    for (const Gap& g : gaps) {
      if (times[g.to] >= times[g.from] + g.gap) continue;
      times[g.to] = times[g.from] + g.gap;
      has_changed = true;
    }
  }
  return times;
}

}  // namespace

std::vector<Path> earliest_paths(const Instance& instance, JointSpace& space,
                                 const std::vector<JointStep>& steps) {
  std::vector<Ticks> earliest;
  for (const JointStep& step : steps) earliest.push_back(std::max(space.when(step).from, Ticks{0}));
  const std::vector<Ticks> times = least_times(gaps_of(space, steps), std::move(earliest));
  std::vector<Path> paths;
  for (std::size_t k = 0; k < space.size(); ++k)
    paths.push_back({{instance.agent(space.agent(k)).start, 0, 0}});
  for (std::size_t at = 0; at < steps.size(); ++at) {
    Path& path = paths[steps[at].agent];
    if (steps[at].begins)
      path.back().depart = times[at];
    else
      path.push_back({instance.roadmap().edge(EdgeId(steps[at].edge)).to, times[at], times[at]});
  }
  return paths;
}

}  // namespace quadrille::continuous
