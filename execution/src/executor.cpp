// SPDX-License-Identifier: MIT
#include "quadrille/execution/executor.hpp"

#include <algorithm>
#include <tuple>

#include "quadrille/core/contract.hpp"

namespace quadrille::execution {

Executor::Executor(const Precedences& precedences) {
  for (const Precedence& p : precedences.list) {
    const TimedMove &leader = precedences.at(p.leader), &follower = precedences.at(p.follower);
    holds_.push_back({precedences.at(precedences.entry(p.follower)).begin, follower.end, leader.end,
                      p.slack, p.leader.agent.value(), p.follower.agent.value(),
                      precedences.is_in_passage(p.follower)});
  }
  std::sort(holds_.begin(), holds_.end(), [](const Hold& a, const Hold& b) {
    return std::tie(a.follower, a.begin, a.end, a.leader, a.leader_end) <
           std::tie(b.follower, b.begin, b.end, b.leader, b.leader_end);
  });
  begin_.resize(precedences.num_agents());
  end_.resize(precedences.num_agents());
  std::size_t at = 0;
  for (std::size_t i = 0; i < begin_.size(); ++i) {
    begin_[i] = at;
    while (at < holds_.size() && holds_[at].follower == i) ++at;
    end_[i] = at;
  }
  reset();
  coupled_.reserve(holds_.size());
}

void Executor::reset() {
  first_ = begin_;
  first_gate_ = begin_;
}

void Executor::check(std::span<const Ticks> clocks, std::span<const Ticks> out) const {
  QUADRILLE_REQUIRE(clocks.size() == num_agents() && out.size() == num_agents(),
                    "one clock per agent");
}

void Executor::skip_over(std::size_t agent, std::span<const Ticks> clocks) {
  std::size_t& first = first_[agent];
  while (first < end_[agent] && is_over(holds_[first], clocks[holds_[first].leader])) ++first;
}

void Executor::limits(std::span<const Ticks> clocks, std::span<Ticks> limits) {
  check(clocks, limits);
  for (std::size_t i = 0; i < num_agents(); ++i) {
    skip_over(i, clocks);
    Ticks limit = kUnlimited;
    for (std::size_t h = first_[i]; h < end_[i] && holds_[h].begin < limit; ++h) {
      const Hold& hold = holds_[h];
      const Ticks leader = clocks[hold.leader];
      if (!is_over(hold, leader))
        limit = std::min(
            limit, hold.is_in_passage ? hold.begin : std::max(hold.begin, leader + hold.slack));
    }
    limits[i] = limit;
  }
}

void Executor::couple(std::span<const Ticks> clocks, std::span<Ticks> targets) {
  check(clocks, targets);
  coupled_.clear();
  for (std::size_t i = 0; i < num_agents(); ++i) {
    skip_over(i, clocks);
    for (std::size_t h = first_[i]; h < end_[i] && holds_[h].begin < targets[i]; ++h) {
      const Hold& hold = holds_[h];
      const Ticks reach = clocks[hold.leader] + hold.slack;
      if (is_over(hold, clocks[hold.leader])) continue;
      // In proportion, both sides of clock <= leader's clock + slack are linear: what holds at both
      // ends of the step holds within. If it does not hold yet, the follower is still before its
      // move, and goes no further than to its beginning; so it does before a passage.
      if (clocks[i] <= reach && !hold.is_in_passage)
        coupled_.push_back(static_cast<std::uint32_t>(h));
      else
        targets[i] = std::max(clocks[i], std::min(targets[i], hold.begin));
    }
  }
  // Shortest ways along holds without negative slack: at most one round per agent.
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::uint32_t h : coupled_) {
      const Hold& hold = holds_[h];
      const Ticks most = std::max(hold.begin, targets[hold.leader] + hold.slack);
      if (targets[hold.follower] <= most) continue;
      targets[hold.follower] = most;
      changed = true;
    }
  }
}

void Executor::gate(std::span<const Ticks> clocks, std::span<Ticks> targets) {
  check(clocks, targets);
  for (std::size_t i = 0; i < num_agents(); ++i) {
    std::size_t& first = first_gate_[i];
    while (first < end_[i] && clocks[holds_[first].leader] >= holds_[first].leader_end) ++first;
    for (std::size_t h = first; h < end_[i] && holds_[h].begin < targets[i]; ++h)
      if (clocks[holds_[h].leader] < holds_[h].leader_end)
        targets[i] = std::max(clocks[i], holds_[h].begin);
  }
}

}  // namespace quadrille::execution
