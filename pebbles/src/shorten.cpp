// SPDX-License-Identifier: MIT
#include "quadrille/pebbles/shorten.hpp"

#include <algorithm>
#include <utility>

namespace quadrille::pebbles {
namespace {

/// One round of `without_loops`.
class LoopFinder {
 public:
  LoopFinder(std::span<const Shift> shifts, std::span<const Local> starts, std::size_t num_vertices)
      : shifts_(shifts), trails_(starts.size()), visits_at_(num_vertices) {
    is_dropped_.assign(shifts.size(), false);
    for (Local agent = 0; agent < starts.size(); ++agent) visit(agent, starts[agent], kStart);
    for (std::size_t k = 0; k < shifts.size(); ++k) {
      const auto [agent, from, to, with_next] = shifts[k];
      if (last_visitor(to) == agent)
        drop_loop(agent, to, k);
      else
        visit(agent, to, k);
    }
  }

  [[nodiscard]] bool has_found_any() const noexcept { return found_; }
  [[nodiscard]] std::vector<Shift> rest(std::span<const Local> starts) const {
    std::vector<Shift> rest;
    std::vector<Local> at(starts.begin(), starts.end());
    for (std::size_t k = 0; k < shifts_.size(); ++k) {
      const Shift& shift = shifts_[k];
      if (is_dropped_[k]) {
        // What is left of a rotation ends with the last of it that is left.
        if (!shift.with_next && !rest.empty() && rest.back().with_next)
          rest.back().with_next = false;
        continue;
      }
      rest.push_back({shift.agent, at[shift.agent], shift.to, shift.with_next});
      at[shift.agent] = shift.to;
    }
    return rest;
  }

 private:
  static constexpr std::size_t kStart = SIZE_MAX;
  using VisitId = std::uint32_t;
  struct Visit {
    Local agent, vertex;
    std::size_t shift;  // That began it.
    bool is_live = true;
  };

  void visit(Local agent, Local vertex, std::size_t shift) {
    const auto id = static_cast<VisitId>(visits_.size());
    visits_.push_back({agent, vertex, shift});
    trails_[agent].push_back(id);
    visits_at_[vertex].push_back(id);
  }

  [[nodiscard]] Local last_visitor(Local vertex) {
    auto& visits = visits_at_[vertex];
    while (!visits.empty() && !visits_[visits.back()].is_live) visits.pop_back();
    return visits.empty() ? kNoLocal : visits_[visits.back()].agent;
  }

  void drop_loop(Local agent, Local to, std::size_t shift) {
    found_ = true;
    is_dropped_[shift] = true;
    auto& trail = trails_[agent];
    for (; visits_[trail.back()].vertex != to; trail.pop_back()) {
      visits_[trail.back()].is_live = false;
      is_dropped_[visits_[trail.back()].shift] = true;
    }
  }

  const std::span<const Shift> shifts_;
  std::vector<Visit> visits_;
  std::vector<std::vector<VisitId>> trails_;     // By agent, live ones.
  std::vector<std::vector<VisitId>> visits_at_;  // By vertex.
  std::vector<bool> is_dropped_;
  bool found_ = false;
};

}  // namespace

std::vector<Shift> without_loops(std::vector<Shift> shifts, std::span<const Local> starts,
                                 std::size_t num_vertices, int rounds) {
  for (; rounds > 0; --rounds) {
    const LoopFinder finder(shifts, starts, num_vertices);
    if (!finder.has_found_any()) break;
    shifts = finder.rest(starts);
  }
  return shifts;
}

std::vector<Timestep> earliest_times(std::span<const Shift> shifts, std::size_t num_agents,
                                     std::size_t num_vertices) {
  std::vector<Timestep> times(shifts.size(), 0), last(num_agents, 0), left(num_vertices, 0);
  std::vector<std::size_t> left_by(num_vertices, 0);  // The end of the last group that left it.
  for (std::size_t begin = 0, end = 0; begin < shifts.size(); begin = end) {
    while (shifts[end].with_next) ++end;
    ++end;
    for (std::size_t k = begin; k < end; ++k) left_by[shifts[k].from] = end;
    Timestep time = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const Shift& shift = shifts[k];
      const Timestep free_from = left_by[shift.to] == end ? 0 : left[shift.to];
      time = std::max({time, last[shift.agent] + 1, free_from});
    }
    for (std::size_t k = begin; k < end; ++k) {
      times[k] = last[shifts[k].agent] = time;
      left[shifts[k].from] = time;
    }
  }
  return times;
}

}  // namespace quadrille::pebbles
